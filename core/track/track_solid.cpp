#include "core/track/track_solid.h"

#include <cassert>
#include <utility>

#include "core/track/solid_rows.h"

namespace trapwright::track {

TrackSolid buildTrackSolid(const FeederShape& shape, std::span<const CrossSection> sections,
                           double baseThickness) {
    assert(sections.size() >= 2 && sections.front().points.size() >= 2);
    const std::vector<CrossSection> rows = subdivideSections(shape, sections);
    const int rowCount = static_cast<int>(rows.size());
    const int pointCount = static_cast<int>(rows.front().points.size());

    TrackSolid solid;
    auto& vertices = solid.mesh.vertices;
    auto& triangles = solid.mesh.triangles;
    vertices.reserve(2 * rows.size() * rows.front().points.size());
    for (const CrossSection& row : rows) {
        for (const base::Vec2& point : row.points)
            vertices.push_back(shape.toRoom({row.x, point.x(), point.y()}));
    }
    for (const CrossSection& row : rows) {
        for (const double y : placeBase(row))
            vertices.push_back(shape.toRoom({row.x, y, -baseThickness}));
    }

    const auto top = [&](int i, int j) { return i * pointCount + j; };
    const auto bottom = [&](int i, int j) { return (rowCount + i) * pointCount + j; };
    // The quad a b d c (a, b on one line, c, d on the next) seen with c ahead of a and b left of it.
    const auto addQuad = [&](int a, int b, int c, int d) {
        triangles.push_back({a, c, b});
        triangles.push_back({b, c, d});
    };
    for (int i = 0; i + 1 < rowCount; ++i) {
        for (int j = 0; j + 1 < pointCount; ++j)
            addQuad(top(i, j), top(i, j + 1), top(i + 1, j), top(i + 1, j + 1));
    }
    solid.surfaceTriangles = triangles.size();

    const int last = pointCount - 1;
    const int end = rowCount - 1;
    for (int i = 0; i < end; ++i) {
        // Inner side, outer side, base.
        addQuad(bottom(i, 0), top(i, 0), bottom(i + 1, 0), top(i + 1, 0));
        addQuad(top(i, last), bottom(i, last), top(i + 1, last), bottom(i + 1, last));
        for (int j = 0; j < last; ++j) {
            addQuad(bottom(i, j + 1), bottom(i, j), bottom(i + 1, j + 1), bottom(i + 1, j));
        }
    }
    for (int j = 0; j < last; ++j) {
        addQuad(top(0, j), bottom(0, j), top(0, j + 1), bottom(0, j + 1));
        addQuad(bottom(end, j), top(end, j), bottom(end, j + 1), top(end, j + 1));
    }

    // Anticlockwise track coordinates are left-handed in the room.
    if (shape.type == FeederType::bowl && shape.conveying == Conveying::anticlockwise) {
        for (geometry::Triangle& triangle : triangles)
            std::swap(triangle[1], triangle[2]);
    }
    return solid;
}

}  // namespace trapwright::track
