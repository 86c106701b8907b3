#include "core/geometry/mesh_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "core/geometry/mass_properties.h"
#include "core/geometry/winding.h"

namespace trapwright::geometry {

namespace {

using GridCell = std::array<std::int64_t, 3>;

std::size_t findRoot(std::vector<std::size_t>& parents, std::size_t i) {
    while (parents[i] != i)
        i = parents[i] = parents[parents[i]];
    return i;
}

TriangleMesh extractShell(const TriangleMesh& mesh, const Shell& shell) {
    TriangleMesh result;
    for (const std::size_t i : shell.triangles) {
        const int first = static_cast<int>(result.vertices.size());
        for (const int vertex : mesh.triangles[i])
            result.vertices.push_back(mesh.vertices[vertex]);
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

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

std::vector<Shell> findShells(const TriangleMesh& mesh) {
    std::vector<std::size_t> parents(mesh.triangles.size());
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    std::map<std::pair<int, int>, std::size_t> firstAt;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const auto edge = std::minmax(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]);
            const auto [place, isNew] = firstAt.emplace(std::pair<int, int>(edge), i);
            if (!isNew) parents[findRoot(parents, i)] = findRoot(parents, place->second);
        }

    std::vector<Shell> shells;
    std::map<std::size_t, std::size_t> shellOfRoot;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const auto [place, isNew] = shellOfRoot.emplace(findRoot(parents, i), shells.size());
        if (isNew) shells.emplace_back();
        shells[place->second].triangles.push_back(i);
    }
    std::vector<TriangleMesh> meshes;
    for (Shell& shell : shells) {
        meshes.push_back(extractShell(mesh, shell));
        shell.volume = calcMassProperties(meshes.back(), 1.0).volume;
    }
    for (std::size_t i = 0; i < shells.size(); ++i)
        for (std::size_t j = 0; j < shells.size(); ++j)
            if (i != j && std::abs(calcWindingNumber(meshes[j], meshes[i].vertices[0])) > 0.5)
                ++shells[i].depth;
    return shells;
}

}  // namespace trapwright::geometry
