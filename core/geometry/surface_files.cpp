#include "core/geometry/surface_files.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/file.h"
#include "core/geometry/ply_format.h"
#include "core/geometry/stl_format.h"
#include "core/geometry/text_surfaces.h"

namespace trapwright::geometry {

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

base::Error makeError(const std::filesystem::path& path, const char* format, const std::string& what) {
    return base::Error{"Cannot read " + path.string() + " as " + format + " file: " + what +
                       ". Copy or export it again."};
}

void appendFan(std::span<const int> polygon, TriangleMesh& mesh) {
    for (std::size_t i = 2; i < polygon.size(); ++i)
        mesh.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
}

void appendPolygon(std::span<const int> polygon, TriangleMesh& mesh) {
    const auto isFinite = [&](int vertex) { return mesh.vertices[vertex].allFinite(); };
    if (polygon.size() == 3 || !std::all_of(polygon.begin(), polygon.end(), isFinite))
        return appendFan(polygon, mesh);
    std::vector<Point> loop;
    for (const int vertex : polygon)
        loop.emplace_back(mesh.vertices[vertex].x(), mesh.vertices[vertex].y(), mesh.vertices[vertex].z());
    std::vector<CGAL::Triple<int, int, int>> pieces;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(loop, std::back_inserter(pieces));
    if (pieces.empty()) return appendFan(polygon, mesh);  // without area
    for (const auto& piece : pieces)
        mesh.triangles.push_back({polygon[piece.first], polygon[piece.second], polygon[piece.third]});
}

using Parse = base::Result<PolygonSoup> (*)(std::string_view);

base::Result<TriangleMesh> readSurface(const std::filesystem::path& path, const char* format, Parse parse) {
    const base::Result<std::string> bytes = base::readFile(path);
    if (!bytes) return bytes.error();
    try {
        base::Result<PolygonSoup> soup = parse(*bytes);
        if (!soup) return makeError(path, format, soup.error().message);
        TriangleMesh mesh;
        mesh.vertices = std::move(soup->points);
        for (std::size_t i = 0; i < soup->ends.size(); ++i)
            appendPolygon(soup->polygon(i), mesh);
        return mesh;
    } catch (const std::exception& failure) {
        return makeError(path, format, failure.what());
    }
}

}  // namespace

base::Result<TriangleMesh> readPly(const std::filesystem::path& path) {
    return readSurface(path, "a PLY", parsePly);
}

base::Result<TriangleMesh> readOff(const std::filesystem::path& path) {
    return readSurface(path, "an OFF", parseOff);
}

base::Result<TriangleMesh> readAnyStl(const std::filesystem::path& path) {
    return readSurface(path, "an STL", parseStl);
}

base::Result<TriangleMesh> readObj(const std::filesystem::path& path) {
    return readSurface(path, "an OBJ", parseObj);
}

}  // namespace trapwright::geometry
