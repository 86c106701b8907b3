#include "core/track/track_solid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace trapwright::track {

std::vector<CrossSection> subdivideSections(const FeederShape& shape,
                                            std::span<const CrossSection> sections) {
    std::vector<CrossSection> rows;
    for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
        const CrossSection& from = sections[i];
        const CrossSection& to = sections[i + 1];
        int pieces = 1;
        if (shape.type == FeederType::bowl) {
            // Rounding must not add a piece to a segment of exactly so many steps.
            const double steps = (to.x - from.x) / (shape.bowlRadius * kLargestBowlStep);
            pieces = std::max(1, static_cast<int>(std::ceil(steps - 1e-9)));
        }
        rows.push_back(from);
        for (int k = 1; k < pieces; ++k) {
            const double t = static_cast<double>(k) / pieces;
            CrossSection between{from.x + t * (to.x - from.x), from.points};
            for (std::size_t j = 0; j < between.points.size(); ++j) {
                between.points[j] += t * (to.points[j] - from.points[j]);
            }
            rows.push_back(std::move(between));
        }
    }
    rows.push_back(sections.back());
    return rows;
}

std::vector<double> placeBase(const CrossSection& row) {
    const bool function = std::adjacent_find(row.points.begin(), row.points.end(),
                                             [](const base::Vec2& a, const base::Vec2& b) {
                                                 return a.x() >= b.x();
                                             }) == row.points.end();
    std::vector<double> places;
    places.reserve(row.points.size());
    for (std::size_t j = 0; j < row.points.size(); ++j) {
        const double t = static_cast<double>(j) / static_cast<double>(row.points.size() - 1);
        places.push_back(function ? row.points[j].x()
                                  : (1.0 - t) * row.points.front().x() + t * row.points.back().x());
    }
    return places;
}

double findBase(const FeederShape& shape, std::span<const CrossSection> sections, double baseThickness) {
    double lowest = std::min(shape.rise(sections.front().x), shape.rise(sections.back().x));
    for (const base::Vec2& point : sections.back().points)
        lowest = std::min(lowest, shape.rise(sections.back().x) + point.y());
    return lowest - baseThickness;
}

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
    const double base = findBase(shape, sections, baseThickness);
    for (const CrossSection& row : rows) {
        for (const double y : placeBase(row)) {
            base::Vec3& vertex = vertices.emplace_back(shape.toRoom({row.x, y, 0.0}));
            vertex.z() = base;
        }
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
