#include "core/geometry/surface_closing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <exception>
#include <string>

#include "core/geometry/mesh_edges.h"

namespace trapwright::geometry {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Halfedge = Surface::Halfedge_index;

base::Vec3 toVec3(const Kernel::Point_3& p) {
    return {p.x(), p.y(), p.z()};
}

Surface makeOrientedSurface(const TriangleMesh& mesh) {
    std::vector<Kernel::Point_3> points;
    for (const base::Vec3& v : mesh.vertices)
        points.emplace_back(v.x(), v.y(), v.z());
    std::vector<std::vector<std::size_t>> polygons;
    for (const Triangle& t : mesh.triangles)
        polygons.push_back(
            {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
    pmp::orient_polygon_soup(points, polygons);
    Surface surface;
    pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);
    // Orienting took sheets apart at edges of many triangles; each sheet's own borders belong together again.
    pmp::stitch_borders(surface, CGAL::parameters::apply_per_connected_component(true));
    pmp::stitch_borders(surface);
    return surface;
}

/// Whether each edge has one triangle on either side, facing alike, and the triangles at each vertex hang
/// together around it: then there is nothing to be done.
bool isClosedManifold(const TriangleMesh& mesh) {
    std::size_t count = 3 * mesh.triangles.size();  // of groups of corners that hang together
    Groups groups(count);
    const auto findCorner = [&](const EdgeSide& side, int vertex) {
        const Triangle& t = mesh.triangles[side.triangle];
        return 3 * side.triangle +
               static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
    };
    bool areEdgesClosed = true;
    forEachEdge(collectSides(mesh), [&](auto first, auto last) {
        if (last - first != 2 || first->forward == (first + 1)->forward) areEdgesClosed = false;
        if (!areEdgesClosed) return;
        for (const int vertex : {first->low, first->high})
            if (groups.join(findCorner(*first, vertex), findCorner(*(first + 1), vertex))) --count;
    });
    if (!areEdgesClosed) return false;
    std::vector<char> used(mesh.vertices.size(), 0);
    for (const Triangle& t : mesh.triangles)
        for (const int vertex : t)
            used[static_cast<std::size_t>(vertex)] = 1;
    return count == static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
}

/// The vertices that triangles use, in the order in which they do so first.
TriangleMesh renumberVertices(const TriangleMesh& mesh) {
    TriangleMesh renumbered;
    renumbered.triangles.reserve(mesh.triangles.size());
    std::vector<int> number(mesh.vertices.size(), -1);
    for (const Triangle& triangle : mesh.triangles) {
        Triangle t{};
        for (std::size_t k = 0; k < 3; ++k) {
            int& known = number[static_cast<std::size_t>(triangle[k])];
            if (known < 0) {
                known = static_cast<int>(renumbered.vertices.size());
                renumbered.vertices.push_back(mesh.vertices[static_cast<std::size_t>(triangle[k])]);
            }
            t[k] = known;
        }
        renumbered.triangles.push_back(t);
    }
    return renumbered;
}

MeshHole describeHole(const Surface& surface, Halfedge rim) {
    MeshHole hole{base::Vec3::Zero()};
    for (const Halfedge h : surface.halfedges_around_face(rim)) {
        const base::Vec3 a = toVec3(surface.point(surface.source(h)));
        const base::Vec3 b = toVec3(surface.point(surface.target(h)));
        const double length = (b - a).norm();
        hole.centre += 0.5 * length * (a + b);
        hole.perimeter += length;
        ++hole.edges;
    }
    hole.centre /= hole.perimeter;
    return hole;
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
                mesh.vertices.push_back(toVec3(surface.point(vertex)));
            }
            t[k++] = known;
        }
        mesh.triangles.push_back(t);
    }
    return mesh;
}

}  // namespace

base::Result<ClosedSurface> closeSurface(const TriangleMesh& mesh, double largestPerimeter) {
    if (isClosedManifold(mesh)) return ClosedSurface{renumberVertices(mesh), {}};
    try {
        Surface surface = makeOrientedSurface(mesh);
        ClosedSurface closed;
        std::vector<Halfedge> rims;
        pmp::extract_boundary_cycles(surface, std::back_inserter(rims));
        for (const Halfedge rim : rims) {
            const MeshHole hole = describeHole(surface, rim);
            if (hole.perimeter > largestPerimeter) continue;
            std::vector<Surface::Face_index> patch;
            pmp::triangulate_hole(surface, rim, std::back_inserter(patch));
            if (!patch.empty()) closed.filled.push_back(hole);
        }
        closed.mesh = toMesh(surface);
        return closed;
    } catch (const std::exception& failure) {
        return base::Error{std::string("the surface cannot be mended: CGAL gave up: ") + failure.what() +
                           ". Repair the mesh in CAD and export it again"};
    }
}

}  // namespace trapwright::geometry
