#pragma once

#include <cmath>
#include <vector>

#include "core/geometry/triangle_mesh.h"

/// Closed, outward oriented meshes whose volumes and features are known.
namespace trapwright::geometry::shapes {

inline TriangleMesh makeBox(const base::Vec3& low, const base::Vec3& high) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                                   (i & 4) != 0 ? high.z() : low.z());
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// A prism with a star-shaped counter-clockwise outline around its first point; from z = 0 to `height`.
inline TriangleMesh makePrism(const std::vector<base::Vec2>& outline, double height) {
    TriangleMesh mesh;
    const int n = static_cast<int>(outline.size());
    for (const double z : {0.0, height})
        for (const base::Vec2& p : outline)
            mesh.vertices.emplace_back(p.x(), p.y(), z);
    for (int i = 1; i + 1 < n; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({n, n + i, n + i + 1});
    }
    for (int i = 0; i < n; ++i) {
        const int j = (i + 1) % n;
        mesh.triangles.push_back({i, j, n + j});
        mesh.triangles.push_back({i, n + j, n + i});
    }
    return mesh;
}

inline std::vector<base::Vec2> makeCircle(int sides, double radius) {
    std::vector<base::Vec2> outline;
    outline.reserve(sides);
    for (int i = 0; i < sides; ++i)
        outline.emplace_back(radius * std::cos(2.0 * base::kPi * i / sides),
                             radius * std::sin(2.0 * base::kPi * i / sides));
    return outline;
}

/// An L of two 10 mm legs, 2 mm thick and 4 mm wide, its reflex corner at (2, 2) mm. Volume 144 mm^3.
inline TriangleMesh makeL() {
    const double mm = base::kMillimetre;
    return makePrism(
        {{2 * mm, 2 * mm}, {2 * mm, 10 * mm}, {0, 10 * mm}, {0, 0}, {10 * mm, 0}, {10 * mm, 2 * mm}}, 4 * mm);
}

/// A body turned about z: rings of `sides` corners at the profile's points (radius, z), the first and the
/// last closed by flat discs. Counter-clockwise around the solid: outside upward, inside downward.
inline TriangleMesh makeTurned(const std::vector<base::Vec2>& profile, int sides) {
    TriangleMesh mesh;
    for (const base::Vec2& ring : profile)
        for (const base::Vec2& p : makeCircle(sides, ring.x()))
            mesh.vertices.emplace_back(p.x(), p.y(), ring.y());
    const int bands = static_cast<int>(profile.size()) - 1;
    for (int band = 0; band < bands; ++band)
        for (int i = 0; i < sides; ++i) {
            const int a = band * sides + i;
            const int b = band * sides + (i + 1) % sides;
            mesh.triangles.push_back({a, b, b + sides});
            mesh.triangles.push_back({a, b + sides, a + sides});
        }
    for (int i = 1; i + 1 < sides; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({bands * sides, bands * sides + i, bands * sides + i + 1});
    }
    return mesh;
}

/// A cup about z: outside radius and height, wall as thick as the bottom. The hollow opens upward.
inline TriangleMesh makeCup(int sides, double radius, double height, double wall) {
    return makeTurned({{radius, 0.0}, {radius, height}, {radius - wall, height}, {radius - wall, wall}},
                      sides);
}

/// A ring about z: circles of `sides` corners and this radius around `around` places on a circle. [m]
inline TriangleMesh makeTorus(int around, int sides, double ring, double radius) {
    TriangleMesh mesh;
    for (int i = 0; i < around; ++i)
        for (const base::Vec2& p : makeCircle(sides, radius)) {
            const double angle = 2.0 * base::kPi * i / around;
            mesh.vertices.emplace_back((ring + p.x()) * std::cos(angle), (ring + p.x()) * std::sin(angle),
                                       p.y());
        }
    for (int i = 0; i < around; ++i)
        for (int k = 0; k < sides; ++k) {
            const int a = i * sides + k;
            const int b = (i + 1) % around * sides + k;
            const int aNext = i * sides + (k + 1) % sides;
            const int bNext = (i + 1) % around * sides + (k + 1) % sides;
            mesh.triangles.push_back({a, b, bNext});
            mesh.triangles.push_back({a, bNext, aNext});
        }
    return mesh;
}

inline double calcCircleArea(int sides, double radius) {
    return 0.5 * sides * radius * radius * std::sin(2.0 * base::kPi / sides);
}

inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const Triangle& t : other.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

inline void turnInsideOut(TriangleMesh& mesh) {
    for (Triangle& t : mesh.triangles)
        std::swap(t[1], t[2]);
}

inline void transform(TriangleMesh& mesh, const base::Pose& pose) {
    for (base::Vec3& vertex : mesh.vertices)
        vertex = pose.apply(vertex);
}

}  // namespace trapwright::geometry::shapes
