#include "core/geometry/wall_thickness.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace trapwright::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr double kOpposite = -0.70710678;  // cosine between the normals of two faces of one wall
constexpr double kCellSize = 1e-3;         // the longest edge of a cell [m]
constexpr double kMostCells = 1e5;         // of a solid, or else they are larger
constexpr double kMargin = 1e-9;           // of rounding [m]
constexpr double kLeastHeight = 1e-5;  // of a triangle over a sharp edge; slivers of rounding are lower [m]

using Corners = std::array<base::Vec3, 3>;

Kernel::Point_3 toPoint(const base::Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

double areaOf(const base::Vec3& a, const base::Vec3& b, const base::Vec3& c) {
    return 0.5 * (b - a).cross(c - a).norm();
}

/// A solid's triangles that have an area, and what is behind a point of them.
class Solid {
 public:
    explicit Solid(const TriangleMesh& mesh) : mesh_(mesh) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const Triangle& t = mesh.triangles[i];
            const base::Vec3 normal = triangleNormal(mesh, i);
            if (normal.isZero()) continue;
            triangles_.emplace_back(toPoint(mesh.vertices[t[0]]), toPoint(mesh.vertices[t[1]]),
                                    toPoint(mesh.vertices[t[2]]));
            numbers_.push_back(i);
            normals_.push_back(normal);
        }
        tree_.rebuild(triangles_.cbegin(), triangles_.cend());
    }

    [[nodiscard]] const std::vector<std::size_t>& numbers() const { return numbers_; }

    /// The faces that the other side of a wall under triangle numbers()[k] can be.
    [[nodiscard]] std::vector<std::size_t> findOpposite(std::size_t k, double farthest) {
        const base::Vec3 way = -farthest * normals_[k];
        CGAL::Bbox_3 box = triangles_[k].bbox();
        box += CGAL::Bbox_3(box.xmin() + way.x() - kMargin, box.ymin() + way.y() - kMargin,
                            box.zmin() + way.z() - kMargin, box.xmax() + way.x() + kMargin,
                            box.ymax() + way.y() + kMargin, box.zmax() + way.z() + kMargin);
        hits_.clear();
        tree_.all_intersected_primitives(box, std::back_inserter(hits_));
        std::vector<std::size_t> faces;
        for (const auto hit : hits_) {
            const auto other = static_cast<std::size_t>(hit - triangles_.cbegin());
            if (normals_[other].dot(normals_[k]) <= kOpposite) faces.push_back(other);
        }
        return faces;
    }
    /// Of these, those that are less than `farthest` below some point of a piece of triangle numbers()[k].
    [[nodiscard]] std::vector<std::size_t> findNear(const std::vector<std::size_t>& faces, std::size_t k,
                                                    const Corners& piece, double farthest) const {
        const base::Vec3 way = -farthest * normals_[k];
        Box box;
        for (const base::Vec3& corner : piece) {
            box.include(corner);
            box.include(corner + way);
        }
        std::vector<std::size_t> near;
        for (const std::size_t face : faces) {
            const CGAL::Bbox_3 other = triangles_[face].bbox();
            if (other.xmax() < box.low.x() - kMargin || other.xmin() > box.high.x() + kMargin ||
                other.ymax() < box.low.y() - kMargin || other.ymin() > box.high.y() + kMargin ||
                other.zmax() < box.low.z() - kMargin || other.zmin() > box.high.z() + kMargin)
                continue;
            // How far above the face's plane: at most as far as along the ray.
            const base::Vec3& there = mesh_.vertices[mesh_.triangles[numbers_[face]][0]];
            double least = std::numeric_limits<double>::infinity();
            double greatest = -least;
            for (const base::Vec3& corner : piece) {
                const double above = normals_[face].dot(there - corner);
                least = std::min(least, above);
                greatest = std::max(greatest, above);
            }
            if (greatest >= -kMargin && least <= farthest + kMargin) near.push_back(face);
        }
        return near;
    }

    /// The way from a point of triangle numbers()[k] to the wall's other side; infinite if there is none
    /// before `farthest`.
    [[nodiscard]] double measure(std::size_t k, const base::Vec3& point, double farthest) {
        const Kernel::Segment_3 way(toPoint(point), toPoint(point - farthest * normals_[k]));
        hits_.clear();
        tree_.all_intersected_primitives(way, std::back_inserter(hits_));
        double nearest = std::numeric_limits<double>::infinity();
        double slopeThere = 0.0;
        for (const auto hit : hits_) {
            const auto other = static_cast<std::size_t>(hit - triangles_.cbegin());
            const double slope = normals_[other].dot(normals_[k]);
            if (other == k || slope >= 0.0) continue;  // the ray leaves through faces that look away
            const base::Vec3& there = mesh_.vertices[mesh_.triangles[numbers_[other]][0]];
            const double distance = normals_[other].dot(there - point) / -slope;
            if (distance < 0.0 || distance >= nearest) continue;
            nearest = distance;
            slopeThere = slope;
        }
        return slopeThere <= kOpposite && nearest < farthest ? nearest
                                                             : std::numeric_limits<double>::infinity();
    }

 private:
    const TriangleMesh& mesh_;
    Triangles triangles_;
    std::vector<std::size_t> numbers_;  // in the mesh
    std::vector<base::Vec3> normals_;
    Tree tree_;
    std::vector<Tree::Primitive_id> hits_;
};

/// Cuts a triangle into cells, and keeps those that are thin.
class CellCut {
 public:
    CellCut(Solid& solid, std::size_t triangle, double size, double thinnest, std::vector<WallCell>& thin)
        : solid_(&solid), triangle_(triangle), size_(size), thinnest_(thinnest), thin_(&thin) {}

    /// Halves the longest edge until none is longer than the size, where there is any face to be near to.
    void cut(const Corners& corners, const std::vector<std::size_t>& faces) {
        const std::vector<std::size_t> near = solid_->findNear(faces, triangle_, corners, thinnest_);
        if (near.empty()) return;
        std::size_t longest = 0;
        std::array<double, 3> lengths{};
        for (std::size_t k = 0; k < 3; ++k) {
            lengths[k] = (corners[(k + 1) % 3] - corners[k]).norm();
            if (lengths[k] > lengths[longest]) longest = k;
        }
        if (lengths[longest] <= size_) return measure(corners);
        const base::Vec3& a = corners[longest];
        const base::Vec3& b = corners[(longest + 1) % 3];
        const base::Vec3& c = corners[(longest + 2) % 3];
        const base::Vec3 middle = 0.5 * (a + b);
        cut({a, middle, c}, near);
        cut({middle, b, c}, near);
    }

 private:
    void measure(const Corners& corners) {
        WallCell cell{static_cast<int>(solid_->numbers()[triangle_]), corners,
                      areaOf(corners[0], corners[1], corners[2]), 0.0};
        cell.thickness = solid_->measure(triangle_, cell.middle(), thinnest_);
        if (cell.thickness < thinnest_) thin_->push_back(cell);
    }

    Solid* solid_;
    std::size_t triangle_;
    double size_;
    double thinnest_;
    std::vector<WallCell>* thin_;
};

}  // namespace

std::vector<WallCell> findThinCells(const TriangleMesh& mesh, double thinnest) {
    Solid solid(mesh);
    double area = 0.0;
    for (const Triangle& t : mesh.triangles)
        area += areaOf(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    // A cell of halved triangles has about a quarter of its longest edge squared.
    const double size = std::max(kCellSize, std::sqrt(4.0 * area / kMostCells));

    std::vector<WallCell> thin;
    for (std::size_t k = 0; k < solid.numbers().size(); ++k) {
        const Triangle& t = mesh.triangles[solid.numbers()[k]];
        CellCut(solid, k, size, thinnest, thin)
            .cut({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]},
                 solid.findOpposite(k, thinnest));
    }
    return thin;
}

std::vector<SharpEdge> findSharpEdges(const TriangleMesh& mesh, double widest) {
    // The first triangle at each edge and its corner across.
    std::map<std::pair<int, int>, std::pair<std::size_t, int>> first;
    std::vector<SharpEdge> edges;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const base::Vec3 normal = triangleNormal(mesh, i);
        if (normal.isZero()) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]);
            const int across = mesh.triangles[i][(k + 2) % 3];
            const auto [place, isNew] = first.try_emplace({low, high}, i, across);
            if (isNew) continue;
            const base::Vec3& from = mesh.vertices[low];
            const base::Vec3& to = mesh.vertices[high];
            const base::Vec3 other = triangleNormal(mesh, place->second.first);
            const base::Vec3 along = (to - from).normalized();
            const base::Vec3 mine = mesh.vertices[across] - from;
            const base::Vec3 theirs = mesh.vertices[place->second.second] - from;
            if (mine.cross(along).norm() < kLeastHeight || theirs.cross(along).norm() < kLeastHeight)
                continue;
            if (mine.dot(other) >= 0.0) continue;  // a notch
            const double angle = base::kPi - std::acos(std::clamp(normal.dot(other), -1.0, 1.0));
            if (angle < widest) edges.push_back({low, high, angle});
        }
    }
    return edges;
}

}  // namespace trapwright::geometry
