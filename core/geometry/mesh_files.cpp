#include "core/geometry/mesh_files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <tuple>

#include "core/base/file.h"

namespace trapwright::geometry {

namespace {

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
