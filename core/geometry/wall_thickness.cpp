#include "core/geometry/wall_thickness.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

namespace trapwright::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr double kOpposite = -0.70710678;  // cosine between the normals of two faces of one wall
constexpr double kSpacing = 1e-3;          // between points on a triangle [m]
constexpr int kMostRows = 12;              // of points on a large triangle

Kernel::Point_3 toPoint(const base::Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

/// The middles of the triangle's even parts, so that none lies on an edge.
std::vector<base::Vec3> spreadPoints(const base::Vec3& a, const base::Vec3& b, const base::Vec3& c) {
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int rows = std::clamp(static_cast<int>(std::ceil(longest / kSpacing)), 2, kMostRows);
    std::vector<base::Vec3> points;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; i + j < rows; ++j) {
            const double u = (i + 1.0 / 3.0) / rows;
            const double v = (j + 1.0 / 3.0) / rows;
            points.push_back((1.0 - u - v) * a + u * b + v * c);
        }
    }
    return points;
}

}  // namespace

std::vector<Wall> measureWalls(const TriangleMesh& mesh, double farthest) {
    Triangles triangles;
    std::vector<std::size_t> numbers;  // in the mesh
    std::vector<base::Vec3> normals;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        const base::Vec3 normal = triangleNormal(mesh, i);
        if (normal.isZero()) continue;
        triangles.emplace_back(toPoint(mesh.vertices[t[0]]), toPoint(mesh.vertices[t[1]]),
                               toPoint(mesh.vertices[t[2]]));
        numbers.push_back(i);
        normals.push_back(normal);
    }
    const Tree tree(triangles.cbegin(), triangles.cend());

    std::vector<Wall> walls(mesh.triangles.size());
    std::vector<Tree::Primitive_id> hits;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const Triangle& t = mesh.triangles[numbers[k]];
        const std::vector<base::Vec3> points =
            spreadPoints(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
        Wall& wall = walls[numbers[k]];
        int behind = 0;
        for (const base::Vec3& point : points) {
            const Kernel::Segment_3 way(toPoint(point), toPoint(point - farthest * normals[k]));
            hits.clear();
            tree.all_intersected_primitives(way, std::back_inserter(hits));
            double nearest = std::numeric_limits<double>::infinity();
            for (const auto hit : hits) {
                const auto other = static_cast<std::size_t>(hit - triangles.cbegin());
                const double slope = normals[other].dot(normals[k]);
                if (other == k || slope > kOpposite) continue;
                const base::Vec3& there = mesh.vertices[mesh.triangles[numbers[other]][0]];
                const double distance = normals[other].dot(there - point) / -slope;
                if (distance >= 0.0) nearest = std::min(nearest, distance);
            }
            if (nearest < farthest) ++behind;
            wall.thickness = std::min(wall.thickness, nearest);
        }
        wall.share = static_cast<double>(behind) / static_cast<double>(points.size());
    }
    return walls;
}

}  // namespace trapwright::geometry
