#include "core/geometry/surface_simplification.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <vector>

#include "core/geometry/surface_distance.h"

namespace trapwright::geometry {

namespace {

/// The triangles of the index list with the vertices that they use.
TriangleMesh extractUsed(const TriangleMesh& mesh, const std::vector<unsigned>& indices) {
    TriangleMesh used;
    std::vector<int> number(mesh.vertices.size(), -1);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        Triangle triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            int& known = number[indices[i + k]];
            if (known < 0) {
                known = static_cast<int>(used.vertices.size());
                used.vertices.push_back(mesh.vertices[indices[i + k]]);
            }
            triangle[k] = known;
        }
        used.triangles.push_back(triangle);
    }
    return used;
}

}  // namespace

SimplifiedSurface simplifySurface(const TriangleMesh& mesh, std::size_t triangles, double tolerance) {
    const Box box = calcBoundingBox(mesh);
    const base::Vec3 middle = 0.5 * (box.low + box.high);
    std::vector<float> positions;
    positions.reserve(3 * mesh.vertices.size());
    for (const base::Vec3& vertex : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis)
            positions.push_back(static_cast<float>(vertex[axis] - middle[axis]));
    std::vector<unsigned> indices;
    indices.reserve(3 * mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles)
        for (const int vertex : triangle)
            indices.push_back(static_cast<unsigned>(vertex));

    constexpr std::size_t kStride = 3 * sizeof(float);
    const float scale = meshopt_simplifyScale(positions.data(), mesh.vertices.size(), kStride);
    std::vector<unsigned> left(indices.size());
    left.resize(meshopt_simplify(left.data(), indices.data(), indices.size(), positions.data(),
                                 mesh.vertices.size(), kStride, 3 * triangles,
                                 static_cast<float>(tolerance) / scale, 0, nullptr));
    SimplifiedSurface result{extractUsed(mesh, left), 0.0};
    if (result.mesh.triangles.empty()) return {mesh, 0.0};
    const SurfaceDistance surface(result.mesh);
    for (const base::Vec3& vertex : mesh.vertices)
        result.deviation = std::max(result.deviation, surface.calcDistance(vertex));
    return result;
}

}  // namespace trapwright::geometry
