#include "core/geometry/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_edges.h"
#include "core/geometry/polygon_faces.h"

namespace trapwright::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr double kCoplanarTolerance = 1e-6;  // of the size; the coordinates of an STL file are good to 1e-7
constexpr double kFlatTolerance = 1e-9;      // of the size

bool isBefore(const base::Vec3& a, const base::Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// The greatest distance of any point from the plane of three far points, over their spread; 0 if all are one
/// point.
double calcRelativeThickness(std::span<const base::Vec3> points) {
    const auto findFarthest = [&](auto&& distance) {
        return *std::max_element(points.begin(), points.end(), [&](const base::Vec3& a, const base::Vec3& b) {
            return distance(a) < distance(b);
        });
    };
    const base::Vec3& a = *std::min_element(points.begin(), points.end(), isBefore);
    const base::Vec3 b = findFarthest([&](const base::Vec3& p) { return (p - a).norm(); });
    const double size = (b - a).norm();
    if (size == 0.0) return 0.0;
    const base::Vec3 direction = (b - a) / size;
    const base::Vec3 c = findFarthest([&](const base::Vec3& p) { return direction.cross(p - a).norm(); });
    const base::Vec3 normal = direction.cross(c - a);
    if (normal.norm() <= kFlatTolerance * size) return 0.0;
    const base::Vec3 d = findFarthest([&](const base::Vec3& p) { return std::abs(normal.dot(p - a)); });
    return std::abs(normal.normalized().dot(d - a)) / size;
}

/// The border of a flat face, counter-clockwise from its lowest vertex; empty if it is not one loop. Edges
/// run from first to second.
std::vector<int> chainBorder(std::vector<std::pair<int, int>>& edges) {
    std::sort(edges.begin(), edges.end());
    std::vector<int> loop;
    for (int vertex = edges.front().first; loop.empty() || vertex != loop.front();) {
        const auto edge = std::lower_bound(edges.begin(), edges.end(), std::pair(vertex, -1));
        if (edge == edges.end() || edge->first != vertex || loop.size() == edges.size()) return {};
        loop.push_back(vertex);
        vertex = edge->second;
    }
    return loop.size() == edges.size() ? loop : std::vector<int>();
}

/// The face of every triangle, a face being triangles that lie in one plane exactly, and the borders of all
/// faces as edges.
struct FlatFaces {
    std::vector<std::size_t> faceOf;
    std::vector<std::vector<std::pair<int, int>>> borders;
};

FlatFaces findFlatFaces(const TriangleMesh& mesh) {
    const auto point = [&](int vertex) {
        const base::Vec3& p = mesh.vertices[static_cast<std::size_t>(vertex)];
        return Kernel::Point_3(p.x(), p.y(), p.z());
    };
    const auto apexOf = [&](const EdgeSide& side) {
        const Triangle& t = mesh.triangles[side.triangle];
        return t[0] + t[1] + t[2] - side.low - side.high;
    };
    const std::size_t count = mesh.triangles.size();
    Groups groups(count);
    const std::vector<EdgeSide> sides = collectSides(mesh);
    forEachEdge(sides, [&](auto first, auto last) {
        if (last - first == 2 && CGAL::coplanar(point(first->low), point(first->high), point(apexOf(*first)),
                                                point(apexOf(*(first + 1)))))
            groups.join((first + 1)->triangle, first->triangle);
    });
    FlatFaces faces;
    std::vector<std::size_t> numberOf(count, count);
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t& number = numberOf[groups.findRoot(i)];
        if (number == count) {
            number = faces.borders.size();
            faces.borders.emplace_back();
        }
        faces.faceOf.push_back(number);
    }
    forEachEdge(sides, [&](auto first, auto last) {
        const std::size_t face = faces.faceOf[first->triangle];
        if (std::all_of(first, last, [&](const EdgeSide& s) { return faces.faceOf[s.triangle] == face; }))
            return;
        for (auto side = first; side != last; ++side)
            faces.borders[faces.faceOf[side->triangle]].push_back(
                side->forward ? std::pair(side->low, side->high) : std::pair(side->high, side->low));
    });
    return faces;
}

/// CGAL leaves vertices inside flat faces and edges, and cuts flat faces into triangles, as the addresses of
/// its vertices have it: by what was in memory before. Cuts them anew, each from its lowest corner.
void recutFlatFaces(TriangleMesh& mesh) {
    FlatFaces faces = findFlatFaces(mesh);
    if (faces.borders.size() == mesh.triangles.size()) return;
    std::vector<std::vector<int>> loops;
    std::vector<int> facesAt(mesh.vertices.size(), 0);
    for (auto& border : faces.borders) {
        loops.push_back(border.empty() ? std::vector<int>() : chainBorder(border));
        for (const int vertex : loops.back())
            ++facesAt[static_cast<std::size_t>(vertex)];
    }
    TriangleMesh cut;
    std::vector<int> number(mesh.vertices.size(), -1);
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (facesAt[i] < 3) continue;  // inside a face or an edge
        number[i] = static_cast<int>(cut.vertices.size());
        cut.vertices.push_back(mesh.vertices[i]);
    }
    for (std::vector<int>& loop : loops) {
        std::erase_if(loop, [&](int vertex) { return number[static_cast<std::size_t>(vertex)] < 0; });
        if (loop.size() < 3) return;  // no clean polygons: better left as it is
        for (std::size_t k = 1; k + 1 < loop.size(); ++k)
            cut.triangles.push_back({number[static_cast<std::size_t>(loop[0])],
                                     number[static_cast<std::size_t>(loop[k])],
                                     number[static_cast<std::size_t>(loop[k + 1])]});
    }
    std::sort(cut.triangles.begin(), cut.triangles.end());
    mesh = std::move(cut);
}

TriangleMesh computeHullTriangles(const std::vector<base::Vec3>& points) {
    std::vector<Kernel::Point_3> input;
    input.reserve(points.size());
    for (const base::Vec3& p : points)
        input.emplace_back(p.x(), p.y(), p.z());

    // Into a surface mesh: as a list of points and triangles CGAL 5.5 gives wrong hulls of turned parts.
    CGAL::Surface_mesh<Kernel::Point_3> surface;
    CGAL::convex_hull_3(input.begin(), input.end(), surface);

    // CGAL's numbering follows the input's order; ours follows the coordinates.
    TriangleMesh mesh;
    for (const auto vertex : surface.vertices()) {
        const Kernel::Point_3& p = surface.point(vertex);
        mesh.vertices.emplace_back(p.x(), p.y(), p.z());
    }
    const std::vector<base::Vec3> unsorted = mesh.vertices;
    std::sort(mesh.vertices.begin(), mesh.vertices.end(), isBefore);
    for (const auto face : surface.faces()) {
        Triangle t{};
        std::size_t k = 0;
        for (const auto vertex : surface.vertices_around_face(surface.halfedge(face)))
            t[k++] = static_cast<int>(
                std::lower_bound(mesh.vertices.begin(), mesh.vertices.end(), unsorted[vertex], isBefore) -
                mesh.vertices.begin());
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        mesh.triangles.push_back(t);
    }
    std::sort(mesh.triangles.begin(), mesh.triangles.end());
    return mesh;
}

/// The hull's triangles as CGAL has them.
base::Result<TriangleMesh> computeTriangles(std::span<const base::Vec3> points) {
    std::vector<base::Vec3> sorted(points.begin(), points.end());
    for (std::size_t i = 0; i < sorted.size(); ++i)
        if (!sorted[i].allFinite())
            return base::Error{"No convex hull: the coordinates of point " + std::to_string(i) +
                               " are not finite numbers. Repair the part's file."};
    std::sort(sorted.begin(), sorted.end(), isBefore);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (!doSpanVolume(sorted))
        return base::Error{
            "No convex hull: the " + std::to_string(sorted.size()) +
            " different points lie in one plane and enclose no volume. Use a part that is a solid."};
    try {
        return computeHullTriangles(sorted);
    } catch (const std::exception& failure) {
        return base::Error{std::string("No convex hull: CGAL gave up: ") + failure.what() +
                           ". Repair the part's mesh."};
    }
}

}  // namespace

bool doSpanVolume(std::span<const base::Vec3> points) {
    return points.size() >= 4 && calcRelativeThickness(points) > kFlatTolerance;
}

base::Result<TriangleMesh> computeHullMesh(std::span<const base::Vec3> points) {
    auto hull = computeTriangles(points);
    if (hull) recutFlatFaces(*hull);
    return hull;
}

base::Result<ConvexPolytope> mergeHullFaces(const TriangleMesh& hull) {
    const double size = (calcBoundingBox(hull).size()).norm();
    // The last, negative one leaves every triangle a face of its own.
    for (const double tolerance : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, -1.0})
        if (auto polytope = mergeCoplanarTriangles(hull, tolerance * kCoplanarTolerance * size))
            return std::move(*polytope);
    return base::Error{"No convex hull: the hull of " + std::to_string(hull.vertices.size()) +
                       " corners has no clean faces. Use a part with fewer tiny triangles."};
}

base::Result<ConvexPolytope> computeConvexHull(std::span<const base::Vec3> points) {
    const auto hull = computeTriangles(points);
    if (!hull) return hull.error();
    return mergeHullFaces(*hull);
}

base::Result<ConvexPolytope> computeConvexHull(const TriangleMesh& mesh) {
    std::vector<base::Vec3> points;
    points.reserve(3 * mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles)
        for (const int vertex : triangle)
            points.push_back(mesh.vertices[vertex]);
    return computeConvexHull(points);
}

TriangleMesh toMesh(const ConvexPolytope& polytope) {
    TriangleMesh mesh;
    mesh.vertices = polytope.vertices;
    for (const PolytopeFace& face : polytope.faces)
        for (std::size_t i = 1; i + 1 < face.loop.size(); ++i)
            mesh.triangles.push_back({face.loop[0], face.loop[i], face.loop[i + 1]});
    return mesh;
}

bool isConvex(const TriangleMesh& mesh, double relativeTolerance) {
    const auto hull = computeConvexHull(mesh);
    if (!hull) return false;
    const double hullVolume = calcMassProperties(toMesh(*hull), 1.0).volume;
    const double volume = calcMassProperties(mesh, 1.0).volume;
    return std::abs(hullVolume - volume) <= relativeTolerance * hullVolume;
}

bool contains(const ConvexPolytope& polytope, const base::Vec3& point, double margin) {
    return std::all_of(polytope.faces.begin(), polytope.faces.end(), [&](const PolytopeFace& face) {
        return face.normal.dot(point) <= face.offset + margin;
    });
}

}  // namespace trapwright::geometry
