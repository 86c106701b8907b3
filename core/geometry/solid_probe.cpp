#include "core/geometry/solid_probe.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

namespace trapwright::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Side = CGAL::Side_of_triangle_mesh<Surface, Kernel, CGAL::Default, Tree>;

Surface makeSurface(const TriangleMesh& mesh) {
    std::vector<Kernel::Point_3> points;
    points.reserve(mesh.vertices.size());
    for (const base::Vec3& v : mesh.vertices)
        points.emplace_back(v.x(), v.y(), v.z());
    std::vector<std::vector<std::size_t>> polygons;
    polygons.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        polygons.push_back(
            {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
    namespace pmp = CGAL::Polygon_mesh_processing;
    // Separates what meets in an edge of more than two triangles, which no surface mesh can hold.
    pmp::orient_polygon_soup(points, polygons);
    Surface surface;
    pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);
    return surface;
}

Kernel::Point_3 toPoint(const base::Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

}  // namespace

struct SolidProbe::Trees {
    explicit Trees(const TriangleMesh& mesh)
        : surface(makeSurface(mesh)), tree(faces(surface).first, faces(surface).second, surface) {
        tree.accelerate_distance_queries();
        side.emplace(tree);
    }

    Surface surface;
    Tree tree;
    std::optional<Side> side;
};

SolidProbe::SolidProbe(const TriangleMesh& mesh) : trees_(std::make_unique<Trees>(mesh)) {}
SolidProbe::~SolidProbe() = default;
SolidProbe::SolidProbe(SolidProbe&&) noexcept = default;
SolidProbe& SolidProbe::operator=(SolidProbe&&) noexcept = default;

base::Vec3 SolidProbe::findNearest(const base::Vec3& point) const {
    const Kernel::Point_3 nearest = trees_->tree.closest_point(toPoint(point));
    return {nearest.x(), nearest.y(), nearest.z()};
}

bool SolidProbe::isInside(const base::Vec3& point) const {
    return (*trees_->side)(toPoint(point)) != CGAL::ON_UNBOUNDED_SIDE;
}

}  // namespace trapwright::geometry
