#include "core/geometry/mesh_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace trapwright::geometry {

namespace {

using GridCell = std::array<std::int64_t, 3>;

struct GridCellHash {
    std::size_t operator()(const GridCell& cell) const {
        std::uint64_t hash = 0;
        for (const std::int64_t number : cell)
            hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15U;
        return hash ^ (hash >> 32U);
    }
};

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
    // Cells much larger than the tolerance: most points are near no border, and one cell is all to be
    // searched.
    const double spacing = std::max(64.0 * tolerance, 1e-300);
    const auto findCell = [&](const base::Vec3& point) {
        GridCell cell{};
        for (int axis = 0; axis < 3; ++axis)
            cell[axis] = static_cast<std::int64_t>(std::floor((point[axis] - origin[axis]) / spacing));
        return cell;
    };
    std::unordered_map<GridCell, std::vector<int>, GridCellHash> grid;
    const auto findNear = [&](const base::Vec3& point) {
        int best = -1;
        // A little more than the tolerance, for the rounding of cells.
        const base::Vec3 reach = base::Vec3::Constant(1.01 * tolerance);
        const GridCell low = findCell(point - reach);
        const GridCell high = findCell(point + reach);
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const auto place = grid.find({x, y, z});
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
                known = findNear(point);
                if (known < 0) {
                    known = static_cast<int>(welded.vertices.size());
                    welded.vertices.push_back(point);
                    grid[findCell(point)].push_back(known);
                }
            }
            t[k] = known;
        }
        welded.triangles.push_back(t);
    }
    return welded;
}

}  // namespace trapwright::geometry
