#include "core/geometry/mesh_edges.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace trapwright::geometry {

namespace {

using GridCell = std::array<std::int64_t, 3>;

std::size_t hashOf(const GridCell& cell) {
    std::uint64_t hash = 0;
    for (const std::int64_t number : cell)
        hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15U;
    return hash ^ (hash >> 32U);
}

/// The numbers of points by the hash of their cell: several cells may share a chain.
class GridChains {
 public:
    explicit GridChains(std::size_t mostPoints) : heads_(std::bit_ceil(mostPoints + 1), -1) {}

    void add(const GridCell& cell, int point) {
        int& head = heads_[hashOf(cell) & (heads_.size() - 1)];
        next_.push_back(head);
        head = point;
    }

    /// Calls `visit` with the points of the cell, and maybe of others.
    template <class Visit>
    void visitNear(const GridCell& cell, Visit visit) const {
        for (int point = heads_[hashOf(cell) & (heads_.size() - 1)]; point >= 0;
             point = next_[static_cast<std::size_t>(point)])
            visit(point);
    }

 private:
    std::vector<int> heads_;
    std::vector<int> next_;  // by point
};

/// Where each number's items begin, and one end more, when items are sorted by number.
template <class Items, class NumberOf>
std::vector<std::size_t> countStarts(const Items& items, std::size_t limit, NumberOf numberOf) {
    std::vector<std::size_t> starts(limit + 1, 0);
    for (const auto& item : items)
        ++starts[static_cast<std::size_t>(numberOf(item)) + 1];
    for (std::size_t i = 0; i < limit; ++i)
        starts[i + 1] += starts[i];
    return starts;
}

}  // namespace

std::vector<EdgeSide> collectSides(const TriangleMesh& mesh) {
    std::vector<EdgeSide> unsorted;
    unsorted.reserve(3 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const int from = mesh.triangles[i][k];
            const int to = mesh.triangles[i][(k + 1) % 3];
            unsorted.push_back({std::min(from, to), std::max(from, to), i, from < to});
        }
    // By the lower vertex into buckets, which are small.
    const std::vector<std::size_t> starts =
        countStarts(unsorted, mesh.vertices.size(), [](const EdgeSide& side) { return side.low; });
    std::vector<EdgeSide> sides(unsorted.size());
    std::vector<std::size_t> ends(starts.begin(), starts.end() - 1);
    for (const EdgeSide& side : unsorted)
        sides[ends[static_cast<std::size_t>(side.low)]++] = side;
    const auto at = [&](std::size_t index) { return sides.begin() + static_cast<std::ptrdiff_t>(index); };
    for (std::size_t vertex = 0; vertex < ends.size(); ++vertex)
        std::sort(at(starts[vertex]), at(ends[vertex]), [](const EdgeSide& a, const EdgeSide& b) {
            return std::pair(a.high, a.triangle) < std::pair(b.high, b.triangle);
        });
    return sides;
}

EdgeUses collectEdges(const TriangleMesh& mesh) {
    EdgeUses edges;
    edges.reserve(2 * mesh.triangles.size());
    forEachEdge(collectSides(mesh), [&](auto first, auto last) {
        EdgeUse use;
        for (auto side = first; side != last; ++side)
            ++(side->forward ? use.forward : use.backward);
        edges.push_back({{first->low, first->high}, use});
    });
    return edges;
}

std::vector<char> findRepeated(const std::vector<Triangle>& triples, std::size_t limit) {
    const std::vector<std::size_t> starts =
        countStarts(triples, limit, [](const Triangle& triple) { return triple[0]; });
    std::vector<std::size_t> order(triples.size());
    std::vector<std::size_t> ends(starts.begin(), starts.end() - 1);
    for (std::size_t i = 0; i < triples.size(); ++i)
        order[ends[static_cast<std::size_t>(triples[i][0])]++] = i;
    const auto isBefore = [&](std::size_t a, std::size_t b) {
        return std::pair(triples[a], a) < std::pair(triples[b], b);
    };
    std::vector<char> repeated(triples.size(), 0);
    for (std::size_t number = 0; number < ends.size(); ++number) {
        const auto first = order.begin() + static_cast<std::ptrdiff_t>(starts[number]);
        const auto last = order.begin() + static_cast<std::ptrdiff_t>(ends[number]);
        std::sort(first, last, isBefore);
        for (auto place = first; place != last; ++place)
            if (place != first && triples[*place] == triples[*(place - 1)]) repeated[*place] = 1;
    }
    return repeated;
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
    GridChains grid(mesh.vertices.size());
    const auto findNear = [&](const base::Vec3& point) {
        int best = -1;
        // A little more than the tolerance, for the rounding of cells.
        const base::Vec3 reach = base::Vec3::Constant(1.01 * tolerance);
        const GridCell low = findCell(point - reach);
        const GridCell high = findCell(point + reach);
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z)
                    grid.visitNear({x, y, z}, [&](int candidate) {
                        if ((welded.vertices[candidate] - point).norm() <= tolerance &&
                            (best < 0 || candidate < best))
                            best = candidate;
                    });
        return best;
    };
    std::vector<int> number(mesh.vertices.size(), -1);
    welded.triangles.reserve(mesh.triangles.size());
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
                    grid.add(findCell(point), known);
                }
            }
            t[k] = known;
        }
        welded.triangles.push_back(t);
    }
    return welded;
}

}  // namespace trapwright::geometry
