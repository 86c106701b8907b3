#include "core/part/shapes.h"

#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace trapwright::part {

using base::Vec2;
using base::Vec3;
using geometry::TriangleMesh;

TriangleMesh makeBox(const Vec3& size) {
    const Vec2 half = 0.5 * size.head<2>();
    const std::array<Vec2, 4> corners = {Vec2(-half.x(), -half.y()), Vec2(half.x(), -half.y()),
                                         Vec2(half.x(), half.y()), Vec2(-half.x(), half.y())};
    TriangleMesh mesh = makePrism(corners, size.z());
    for (Vec3& vertex : mesh.vertices)
        vertex.z() -= 0.5 * size.z();
    return mesh;
}

TriangleMesh makePrism(std::span<const Vec2> polygon, double depth) {
    assert(polygon.size() >= 3);
    TriangleMesh mesh;
    const int count = static_cast<int>(polygon.size());
    for (const double z : {0.0, depth}) {
        for (const Vec2& corner : polygon)
            mesh.vertices.emplace_back(corner.x(), corner.y(), z);
    }
    for (int i = 0; i < count; ++i) {
        const int next = (i + 1) % count;
        mesh.triangles.push_back({i, next, count + next});
        mesh.triangles.push_back({i, count + next, count + i});
    }
    for (int i = 1; i + 1 < count; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({count, count + i, count + i + 1});
    }
    return mesh;
}

TriangleMesh makeTurned(std::span<const Vec2> profile, int facets) {
    assert(profile.size() >= 3 && facets >= 3);
    assert(profile.front().x() == 0.0 && profile.back().x() == 0.0);
    TriangleMesh mesh;
    // Index of the ring's vertex at a facet; the two ends have one vertex only.
    std::vector<int> firstOf;
    for (const Vec2& point : profile) {
        firstOf.push_back(static_cast<int>(mesh.vertices.size()));
        const int copies = point.x() == 0.0 ? 1 : facets;
        for (int k = 0; k < copies; ++k) {
            const double angle = 2.0 * base::kPi * k / facets;
            mesh.vertices.emplace_back(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y());
        }
    }
    const auto vertex = [&](std::size_t ring, int k) {
        return profile[ring].x() == 0.0 ? firstOf[ring] : firstOf[ring] + k % facets;
    };
    for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
        for (int k = 0; k < facets; ++k) {
            const int a = vertex(ring, k);
            const int b = vertex(ring, k + 1);
            const int c = vertex(ring + 1, k + 1);
            const int d = vertex(ring + 1, k);
            if (a != b) mesh.triangles.push_back({a, b, c});
            if (c != d) mesh.triangles.push_back({a, c, d});
        }
    }
    return mesh;
}

}  // namespace trapwright::part
