#include "core/geometry/solid_cut.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Surface_mesh.h>

#include <cassert>
#include <cmath>
#include <exception>
#include <string>

namespace trapwright::geometry {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

base::Result<Surface> toSurface(const TriangleMesh& mesh) {
    std::vector<Kernel::Point_3> points;
    points.reserve(mesh.vertices.size());
    for (const base::Vec3& v : mesh.vertices)
        points.emplace_back(v.x(), v.y(), v.z());
    std::vector<std::vector<std::size_t>> polygons;
    polygons.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        polygons.push_back(
            {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
    pmp::repair_polygon_soup(points, polygons);
    Surface surface;
    if (!pmp::is_polygon_soup_a_polygon_mesh(polygons))
        return base::Error{"The solid cannot be cut: some of its edges belong to more than two triangles."};
    pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);
    if (!CGAL::is_closed(surface)) return base::Error{"The solid cannot be cut: it is not closed."};
    return surface;
}

TriangleMesh toMesh(const Surface& surface) {
    TriangleMesh mesh;
    std::vector<int> number(surface.num_vertices() + surface.number_of_removed_vertices(), -1);
    for (const auto face : surface.faces()) {
        Triangle t{};
        std::size_t k = 0;
        for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
            int& known = number[vertex];
            if (known < 0) {
                known = static_cast<int>(mesh.vertices.size());
                const Kernel::Point_3& p = surface.point(vertex);
                mesh.vertices.emplace_back(p.x(), p.y(), p.z());
            }
            t[k++] = known;
        }
        mesh.triangles.push_back(t);
    }
    return mesh;
}

template <class Corefine>
base::Result<TriangleMesh> cut(const TriangleMesh& solid, const TriangleMesh& tool, Corefine corefine) {
    try {
        auto first = toSurface(solid);
        if (!first) return first.error();
        auto second = toSurface(tool);
        if (!second) return second.error();
        Surface result;
        if (!corefine(*first, *second, result))
            return base::Error{"The solid cannot be cut: what is left would touch itself in an edge."};
        return toMesh(result);
    } catch (const std::exception&) {
        return base::Error{"The solid cannot be cut: its surface crosses itself there."};
    }
}

}  // namespace

base::Result<TriangleMesh> subtractSolid(const TriangleMesh& solid, const TriangleMesh& tool) {
    return cut(solid, tool, [](Surface& a, Surface& b, Surface& result) {
        return pmp::corefine_and_compute_difference(a, b, result,
                                                    CGAL::parameters::throw_on_self_intersection(true));
    });
}

base::Result<TriangleMesh> intersectSolids(const TriangleMesh& solid, const TriangleMesh& tool) {
    return cut(solid, tool, [](Surface& a, Surface& b, Surface& result) {
        return pmp::corefine_and_compute_intersection(a, b, result,
                                                      CGAL::parameters::throw_on_self_intersection(true));
    });
}

TriangleMesh makeCylinder(const base::Vec2& centre, double radius, double low, double high, int sides) {
    assert(sides >= 3 && radius > 0.0 && low < high);
    TriangleMesh mesh;
    for (const double z : {low, high}) {
        for (int i = 0; i < sides; ++i) {
            const double angle = 2.0 * base::kPi * i / sides;
            mesh.vertices.emplace_back(centre.x() + radius * std::cos(angle),
                                       centre.y() + radius * std::sin(angle), z);
        }
    }
    for (int i = 0; i < sides; ++i) {
        const int j = (i + 1) % sides;
        mesh.triangles.push_back({i, j, sides + j});
        mesh.triangles.push_back({i, sides + j, sides + i});
    }
    for (int i = 1; i + 1 < sides; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({sides, sides + i, sides + i + 1});
    }
    return mesh;
}

}  // namespace trapwright::geometry
