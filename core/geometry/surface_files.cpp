#include "core/geometry/surface_files.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

namespace trapwright::geometry {

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Points = std::vector<Point>;
using Polygons = std::vector<std::vector<std::size_t>>;

base::Error damaged(const std::filesystem::path& path, const char* format, const std::string& what) {
    return base::Error{"Cannot read " + path.string() + " as a " + format + " file: " + what +
                       ". Copy or export it again."};
}

void appendPolygon(const Points& points, const std::vector<std::size_t>& polygon, TriangleMesh& mesh) {
    const auto corner = [&](std::size_t i) { return static_cast<int>(polygon[i]); };
    if (polygon.size() < 3) return;
    if (polygon.size() == 3) {
        mesh.triangles.push_back({corner(0), corner(1), corner(2)});
        return;
    }
    Points loop;
    for (const std::size_t vertex : polygon)
        loop.push_back(points[vertex]);
    std::vector<CGAL::Triple<int, int, int>> pieces;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(loop, std::back_inserter(pieces));
    for (const auto& piece : pieces)
        mesh.triangles.push_back({corner(piece.first), corner(piece.second), corner(piece.third)});
}

template <class Read>
base::Result<TriangleMesh> readSurface(const std::filesystem::path& path, const char* format, Read read) {
    Points points;
    Polygons polygons;
    try {
        std::ifstream file(path, std::ios::binary);
        if (!file) return damaged(path, format, "it cannot be opened");
        if (!read(file, points, polygons)) return damaged(path, format, "it is damaged or was cut short");

        TriangleMesh mesh;
        for (const Point& point : points)
            mesh.vertices.emplace_back(point.x(), point.y(), point.z());
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            const bool whole = std::all_of(polygons[i].begin(), polygons[i].end(),
                                           [&](std::size_t vertex) { return vertex < points.size(); });
            if (!whole)
                return damaged(path, format,
                               "face " + std::to_string(i + 1) + " has a vertex that is not there");
            appendPolygon(points, polygons[i], mesh);
        }
        return mesh;
    } catch (const std::exception& failure) {
        return damaged(path, format, failure.what());
    }
}

}  // namespace

base::Result<TriangleMesh> readPly(const std::filesystem::path& path) {
    return readSurface(path, "PLY", [](std::istream& file, Points& points, Polygons& polygons) {
        return CGAL::IO::read_PLY(file, points, polygons);
    });
}

base::Result<TriangleMesh> readOff(const std::filesystem::path& path) {
    return readSurface(path, "OFF", [](std::istream& file, Points& points, Polygons& polygons) {
        return CGAL::IO::read_OFF(file, points, polygons, CGAL::parameters::verbose(false));
    });
}

}  // namespace trapwright::geometry
