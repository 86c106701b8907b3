#include "core/geometry/mesh_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace trapwright::geometry {

namespace {

using GridCell = std::array<std::int64_t, 3>;

}  // namespace

EdgeUses collectEdges(const TriangleMesh& mesh) {
    EdgeUses edges;
    for (const Triangle& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const int from = t[k];
            const int to = t[(k + 1) % 3];
            if (from < to)
                ++edges[{from, to}].forward;
            else
                ++edges[{to, from}].backward;
        }
    return edges;
}

bool isDegenerate(const TriangleMesh& mesh, const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ||
           (mesh.vertices[t[1]] - mesh.vertices[t[0]])
               .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
               .isZero(0.0);
}

TriangleMesh weldVertices(const TriangleMesh& mesh, double tolerance) {
    TriangleMesh welded;
    const base::Vec3 origin = calcBoundingBox(mesh).low;
    const double spacing = std::max(tolerance, 1e-300);
    std::map<GridCell, std::vector<int>> grid;
    const auto findNear = [&](const base::Vec3& point, const GridCell& cell) {
        int best = -1;
        for (int i = 0; i < 27; ++i) {
            const auto place = grid.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
            if (place == grid.end()) continue;
            for (const int candidate : place->second)
                if ((welded.vertices[candidate] - point).norm() <= tolerance &&
                    (best < 0 || candidate < best))
                    best = candidate;
        }
        return best;
    };
    std::vector<int> number(mesh.vertices.size(), -1);
    for (const Triangle& triangle : mesh.triangles) {
        Triangle t{};
        for (int k = 0; k < 3; ++k) {
            int& known = number[triangle[k]];
            if (known < 0) {
                const base::Vec3& point = mesh.vertices[triangle[k]];
                GridCell cell{};
                for (int axis = 0; axis < 3; ++axis)
                    cell[axis] =
                        static_cast<std::int64_t>(std::floor((point[axis] - origin[axis]) / spacing));
                known = findNear(point, cell);
                if (known < 0) {
                    known = static_cast<int>(welded.vertices.size());
                    welded.vertices.push_back(point);
                    grid[cell].push_back(known);
                }
            }
            t[k] = known;
        }
        welded.triangles.push_back(t);
    }
    return welded;
}

}  // namespace trapwright::geometry
