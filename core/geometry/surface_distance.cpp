#include "core/geometry/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unsupported/Eigen/BVH>
#include <vector>

namespace trapwright::geometry {

namespace {

using base::Vec3;
using Bounds = Eigen::AlignedBox3d;
using Corners = std::array<Vec3, 3>;

/// Closest point of a triangle by the region of the plane that the point is over (Ericson, Real-Time
/// Collision Detection, 2005, section 5.1.5).
double calcSquaredDistance(const Corners& triangle, const Vec3& p) {
    const auto& [a, b, c] = triangle;
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 ap = p - a;
    const double d1 = ab.dot(ap);
    const double d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return ap.squaredNorm();
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp);
    const double d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return bp.squaredNorm();
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp);
    const double d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return cp.squaredNorm();
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return (a + d1 / (d1 - d3) * ab - p).squaredNorm();
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return (a + d2 / (d2 - d6) * ac - p).squaredNorm();
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        return (b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b) - p).squaredNorm();
    }
    const double sum = va + vb + vc;
    return (a + vb / sum * ab + vc / sum * ac - p).squaredNorm();
}

/// The query that Eigen's BVMinimize asks for bounds (its interface fixes the names).
struct Nearest {
    using Scalar = double;

    const std::vector<Corners>& triangles;
    Vec3 point;

    [[nodiscard]] double minimumOnVolume(const Bounds& box) const {
        return box.squaredExteriorDistance(point);
    }
    [[nodiscard]] double minimumOnObject(int triangle) const {
        return calcSquaredDistance(triangles[static_cast<std::size_t>(triangle)], point);
    }
};

}  // namespace

struct SurfaceDistance::Tree {
    std::vector<Corners> triangles;
    Eigen::KdBVH<double, 3, int> boxes;
};

SurfaceDistance::SurfaceDistance(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
    std::vector<int> indices;
    std::vector<Bounds> boxes;
    for (const Triangle& triangle : mesh.triangles) {
        Corners corners;
        Bounds box;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = mesh.vertices[static_cast<std::size_t>(triangle[k])];
            box.extend(corners[k]);
        }
        indices.push_back(static_cast<int>(indices.size()));
        tree_->triangles.push_back(corners);
        boxes.push_back(box);
    }
    tree_->boxes.init(indices.begin(), indices.end(), boxes.begin(), boxes.end());
}

SurfaceDistance::~SurfaceDistance() = default;
SurfaceDistance::SurfaceDistance(SurfaceDistance&&) noexcept = default;
SurfaceDistance& SurfaceDistance::operator=(SurfaceDistance&&) noexcept = default;

double SurfaceDistance::calcDistance(const Vec3& point) const {
    Nearest query{tree_->triangles, point};
    return std::sqrt(Eigen::BVMinimize(tree_->boxes, query));
}

}  // namespace trapwright::geometry
