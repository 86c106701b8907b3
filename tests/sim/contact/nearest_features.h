#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/convex_polytope.h"
#include "core/geometry/triangle_mesh.h"

/// Distances by plain geometry, feature by feature: what the detector is held against. All in metres.
namespace trapwright::testing {

inline double calcSegmentDistance(const base::Vec3& a, const base::Vec3& b, const base::Vec3& c,
                                  const base::Vec3& d) {
    const base::Vec3 ab = b - a;
    const base::Vec3 cd = d - c;
    const base::Vec3 ca = a - c;
    const double determinant = ab.squaredNorm() * cd.squaredNorm() - std::pow(ab.dot(cd), 2);
    double s = 0.0;
    if (determinant > 1e-30)
        s = std::clamp((ab.dot(cd) * cd.dot(ca) - ab.dot(ca) * cd.squaredNorm()) / determinant, 0.0, 1.0);
    const double t = std::clamp((ab.dot(cd) * s + cd.dot(ca)) / cd.squaredNorm(), 0.0, 1.0);
    s = std::clamp((ab.dot(cd) * t - ab.dot(ca)) / ab.squaredNorm(), 0.0, 1.0);
    return (a + s * ab - c - t * cd).norm();
}

/// Of a point above a triangle's inside; infinite elsewhere.
inline double calcDistanceToInside(const base::Vec3& point, const base::Vec3& a, const base::Vec3& b,
                                   const base::Vec3& c) {
    const base::Vec3 normal = (b - a).cross(c - a).normalized();
    const auto beyond = [&](const base::Vec3& from, const base::Vec3& to) {
        return (to - from).cross(normal).dot(point - from) > 0.0;
    };
    if (beyond(a, b) || beyond(b, c) || beyond(c, a)) return std::numeric_limits<double>::infinity();
    return std::abs(normal.dot(point - a));
}

/// Of a point in front of one of the polytope's faces; infinite elsewhere.
inline double calcDistanceToFaces(const geometry::ConvexPolytope& polytope, const base::Vec3& point) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const geometry::PolytopeFace& face : polytope.faces) {
        const double height = face.normal.dot(point) - face.offset;
        if (height < 0.0) continue;
        bool inside = true;
        for (std::size_t i = 0; i < face.loop.size() && inside; ++i) {
            const base::Vec3& from = polytope.vertices[face.loop[i]];
            const base::Vec3& to = polytope.vertices[face.loop[(i + 1) % face.loop.size()]];
            inside = (to - from).cross(face.normal).dot(point - from) <= 0.0;
        }
        if (inside) nearest = std::min(nearest, height);
    }
    return nearest;
}

/// Between a polytope in a pose and a mesh that it does not overlap.
inline double calcDistance(const geometry::ConvexPolytope& polytope, const base::Pose& pose,
                           const geometry::TriangleMesh& mesh) {
    std::vector<base::Vec3> corners;
    double radius = 0.0;
    for (const base::Vec3& vertex : polytope.vertices) {
        corners.push_back(pose.apply(vertex));
        radius = std::max(radius, vertex.norm());
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const geometry::Triangle& triangle : mesh.triangles) {
        const base::Vec3 t[3] = {mesh.vertices[triangle[0]], mesh.vertices[triangle[1]],
                                 mesh.vertices[triangle[2]]};
        const base::Vec3 centre = (t[0] + t[1] + t[2]) / 3.0;
        const double size =
            std::max({(t[0] - centre).norm(), (t[1] - centre).norm(), (t[2] - centre).norm()});
        if ((centre - pose.position).norm() > size + radius + std::min(nearest, 1.0)) continue;
        for (const base::Vec3& corner : corners)
            nearest = std::min(nearest, calcDistanceToInside(corner, t[0], t[1], t[2]));
        for (int side = 0; side < 3; ++side) {
            const base::Vec3 local = pose.rotation.conjugate() * (t[side] - pose.position);
            nearest = std::min(nearest, calcDistanceToFaces(polytope, local));
            for (const geometry::PolytopeEdge& edge : polytope.edges)
                nearest = std::min(nearest, calcSegmentDistance(corners[edge.from], corners[edge.to], t[side],
                                                                t[(side + 1) % 3]));
        }
    }
    return nearest;
}

}  // namespace trapwright::testing
