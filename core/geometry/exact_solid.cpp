#include "core/geometry/exact_solid.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <exception>
#include <map>
#include <vector>

#include "core/geometry/mass_properties.h"

namespace trapwright::geometry {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Faces = CGAL::Surface_mesh<Kernel::Point_3>;

// By how much of itself the second solid grows where faces that lie on each other but for rounding come out
// entangled: more than the rounding of doubles, then than that of floats.
constexpr std::array<double, 3> kGrowths = {0.0, 1e-10, 1e-7};
// The same where faces part from corners in common.
constexpr std::array<double, 3> kTouchGrowths = {1e-10, 1e-9, 1e-8};
constexpr double kOffsetDamping = 1e-6;   // against faces that are nearly parallel
constexpr double kFarthestOffset = 4.0;   // of a corner, when its faces move by 1
constexpr double kNarrowestFace = 100.0;  // that is more than an edge, in tolerances
constexpr double kMostOverlap = 3.0;      // of faces that lie on each other, in tolerances

/// To the nearest number; CGAL's own conversion of numbers that are not yet known exactly is good to 1e-5.
double round(const Kernel::FT& number) {
    return CGAL::to_double(CGAL::exact(number));
}

/// Faces that are apart by no more than rounding have been seen to come out entangled.
bool isSound(const Faces& faces) {
    return faces.is_valid(false) && CGAL::is_valid_polygon_mesh(faces) && CGAL::is_closed(faces) &&
           CGAL::is_triangle_mesh(faces);
}

}  // namespace

struct ExactSolid::Surface {
    Faces faces;
};

namespace {

/// About the middle of the corners, by a share of itself.
Faces grow(const Faces& faces, double share) {
    Faces grown = faces;
    if (share == 0.0 || faces.is_empty()) return grown;
    Kernel::Vector_3 sum(0, 0, 0);
    for (const auto vertex : grown.vertices())
        sum = sum + (grown.point(vertex) - CGAL::ORIGIN);
    const Kernel::Point_3 middle = CGAL::ORIGIN + sum / static_cast<double>(grown.num_vertices());
    for (const auto vertex : grown.vertices())
        grown.point(vertex) = middle + (1.0 + share) * (grown.point(vertex) - middle);
    return grown;
}

/// With every face moved outward by a length.
Faces offset(const Faces& faces, double length) {
    std::map<Faces::Face_index, base::Vec3> normals;
    const auto calcPlace = [&](Faces::Vertex_index vertex) {
        const Kernel::Point_3& p = faces.point(vertex);
        return base::Vec3(round(p.x()), round(p.y()), round(p.z()));
    };
    for (const auto face : faces.faces()) {
        std::array<base::Vec3, 3> corners;
        std::size_t k = 0;
        for (const auto vertex : faces.vertices_around_face(faces.halfedge(face)))
            corners[k++] = calcPlace(vertex);
        normals[face] = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    }
    Faces moved = faces;
    for (const auto vertex : faces.vertices()) {
        // A corner goes where it is by that much in front of each of its faces, or as near as can be.
        base::Mat3 matrix = kOffsetDamping * base::Mat3::Identity();
        base::Vec3 sum = base::Vec3::Zero();
        for (const auto face : faces.faces_around_target(faces.halfedge(vertex))) {
            if (face == Faces::null_face()) continue;
            matrix += normals[face] * normals[face].transpose();
            sum += normals[face];
        }
        base::Vec3 way = matrix.inverse() * sum;
        if (way.norm() > kFarthestOffset) way *= kFarthestOffset / way.norm();
        way *= length;
        moved.point(vertex) = faces.point(vertex) + Kernel::Vector_3(way.x(), way.y(), way.z());
    }
    return moved;
}

/// None if a result came out entangled.
std::optional<SolidCombination> tryCombine(Faces first, Faces second) {
    std::array<std::shared_ptr<ExactSolid::Surface>, 3> results;
    for (auto& result : results)
        result = std::make_shared<ExactSolid::Surface>();
    // In CGAL's order: union, intersection, first without second, second without first.
    const std::array<boost::optional<Faces*>, 4> wanted = {&results[0]->faces, &results[1]->faces,
                                                           &results[2]->faces, boost::none};
    const std::array<bool, 4> made = pmp::corefine_and_compute_boolean_operations(
        first, second, wanted, CGAL::parameters::throw_on_self_intersection(true));
    for (std::size_t i = 0; i < results.size(); ++i)
        if (made[i] && !isSound(results[i]->faces)) return std::nullopt;
    SolidCombination combination;
    if (made[0]) combination.whole.emplace(std::move(results[0]));
    if (made[1]) combination.common.emplace(std::move(results[1]));
    if (made[2]) combination.rest.emplace(std::move(results[2]));
    return combination;
}

}  // namespace

ExactSolid::ExactSolid(const TriangleMesh& mesh) {
    std::vector<Kernel::Point_3> points;
    points.reserve(mesh.vertices.size());
    for (const base::Vec3& v : mesh.vertices)
        points.emplace_back(v.x(), v.y(), v.z());
    std::vector<std::array<std::size_t, 3>> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        triangles.push_back(
            {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
    auto surface = std::make_shared<Surface>();
    pmp::polygon_soup_to_polygon_mesh(points, triangles, surface->faces);
    surface_ = std::move(surface);
}

TriangleMesh ExactSolid::toMesh() const {
    TriangleMesh mesh;
    const Faces& faces = surface_->faces;
    std::vector<int> number(faces.num_vertices() + faces.number_of_removed_vertices(), -1);
    for (const auto face : faces.faces()) {
        Triangle t{};
        std::size_t k = 0;
        for (const auto vertex : faces.vertices_around_face(faces.halfedge(face))) {
            int& known = number[vertex];
            if (known < 0) {
                known = static_cast<int>(mesh.vertices.size());
                const Kernel::Point_3& p = faces.point(vertex);
                mesh.vertices.emplace_back(round(p.x()), round(p.y()), round(p.z()));
            }
            t[k++] = known;
        }
        mesh.triangles.push_back(t);
    }
    return mesh;
}

double ExactSolid::calcVolume() const {
    return calcMassProperties(toMesh(), 1.0).volume;
}

std::optional<SolidCombination> combineTouching(const ExactSolid& first, const ExactSolid& second,
                                                Touching touching, double tolerance) {
    const Faces& faces = first.surface().faces;
    const TriangleMesh mesh = second.toMesh();
    const double size = calcBoundingBox(mesh).size().norm();
    const bool isOutside = touching == Touching::fromOutside;
    try {
        auto thick = std::make_shared<ExactSolid::Surface>();
        thick->faces = offset(second.surface().faces, tolerance);
        const auto probe = tryCombine(faces, thick->faces);
        if (!probe || !probe->common) return std::nullopt;
        // Where faces lie on each other, this is as deep as the tolerance, and as wide as they are.
        const double common = probe->common->calcVolume();
        const double beyond = isOutside ? common : ExactSolid(thick).calcVolume() - common;
        if (beyond < kNarrowestFace * tolerance * tolerance * size ||
            beyond > kMostOverlap * tolerance * calcMassProperties(mesh, 1.0).area)
            return std::nullopt;
        for (const double growth : kTouchGrowths) {
            auto combination = tryCombine(faces, offset(second.surface().faces, growth * size));
            if (combination && combination->common && (isOutside ? combination->whole : combination->rest))
                return combination;
        }
    } catch (const std::exception&) {
        return std::nullopt;  // it would cross itself
    }
    return std::nullopt;
}

base::Result<SolidCombination> combineSolids(const ExactSolid& first, const ExactSolid& second) {
    try {
        for (const double growth : kGrowths)
            if (auto combination = tryCombine(first.surface().faces, grow(second.surface().faces, growth)))
                return std::move(*combination);
        return base::Error{"their faces lie on each other but for rounding"};
    } catch (const std::exception&) {
        return base::Error{"its surface crosses itself there"};
    }
}

}  // namespace trapwright::geometry
