#include "core/geometry/mesh_files.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/base/file.h"
#include "core/geometry/polygon_soup.h"

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

using Float3 = std::array<float, 3>;

static_assert(std::endian::native == std::endian::little,
              "STL is little-endian and is copied as it is in memory");

constexpr std::size_t kHeaderSize = 80;
constexpr std::size_t kTriangleSize = 50;
constexpr std::size_t kPrefixSize = kHeaderSize + sizeof(std::uint32_t);

Float3 toMillimetres(const base::Vec3& point) {
    const base::Vec3 scaled = point / base::kMillimetre;
    return {static_cast<float>(scaled.x()), static_cast<float>(scaled.y()), static_cast<float>(scaled.z())};
}

void append(std::string& bytes, const Float3& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), sizeof values);
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

base::Status writeStl(const std::filesystem::path& path, const TriangleMesh& mesh) {
    if (mesh.triangles.empty())
        return base::Error{"Cannot write " + path.string() + ": the mesh has no triangles."};
    std::string bytes =
        "Trapwright binary STL, unit: mm";  // must not begin with "solid", which marks a text file
    bytes.resize(kPrefixSize, ' ');
    bytes.reserve(kPrefixSize + kTriangleSize * mesh.triangles.size());
    std::uint32_t count = 0;
    for (const Triangle& triangle : mesh.triangles) {
        std::array<Float3, 3> corners{};
        for (int k = 0; k < 3; ++k) {
            corners[k] = toMillimetres(mesh.vertices[triangle[k]]);
            if (!std::all_of(corners[k].begin(), corners[k].end(), [](float x) { return std::isfinite(x); }))
                return base::Error{"Cannot write " + path.string() + ": vertex " +
                                   std::to_string(triangle[k]) +
                                   " has a coordinate that is not a finite number. Repair the mesh first."};
        }
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        const base::Vec3& a = mesh.vertices[triangle[0]];
        const base::Vec3 normal =
            (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a).stableNormalized();
        append(bytes, {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                       static_cast<float>(normal.z())});
        for (const Float3& corner : corners)
            append(bytes, corner);
        bytes.append(2, '\0');
        ++count;
    }
    std::memcpy(bytes.data() + kHeaderSize, &count, sizeof count);
    return base::writeFile(path, bytes);
}

base::Result<TriangleMesh> readStl(const std::filesystem::path& path) {
    const base::Result<std::string> bytes = base::readFile(path);
    if (!bytes) return bytes.error();
    const auto fail = [&](const std::string& what) {
        return base::Error{"Cannot read " + path.string() + ": " + what};
    };
    if (bytes->size() < kPrefixSize) return fail("it is too short for a binary STL file.");
    std::uint32_t count = 0;
    std::memcpy(&count, bytes->data() + kHeaderSize, sizeof count);
    const std::size_t expected = kPrefixSize + kTriangleSize * static_cast<std::size_t>(count);
    if (bytes->size() != expected)
        return fail("a binary STL file of " + std::to_string(count) + " triangles has " +
                    std::to_string(expected) + " bytes, this one has " + std::to_string(bytes->size()) +
                    ". It is cut off or not binary; export it again.");

    TriangleMesh mesh;
    std::map<Float3, int> known;
    for (std::uint32_t i = 0; i < count; ++i) {
        std::array<Float3, 4> normalAndCorners{};
        std::memcpy(normalAndCorners.data(), bytes->data() + kPrefixSize + kTriangleSize * i,
                    sizeof normalAndCorners);
        Triangle triangle{};
        for (int k = 0; k < 3; ++k) {
            const Float3& corner = normalAndCorners[k + 1];
            if (!std::all_of(corner.begin(), corner.end(), [](float x) { return std::isfinite(x); }))
                return fail("triangle " + std::to_string(i) +
                            " has a coordinate that is not a finite number.");
            const auto [place, isNew] = known.emplace(corner, static_cast<int>(mesh.vertices.size()));
            if (isNew)
                mesh.vertices.push_back(base::Vec3(corner[0], corner[1], corner[2]) * base::kMillimetre);
            triangle[k] = place->second;
        }
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

}  // namespace trapwright::geometry
