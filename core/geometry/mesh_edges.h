#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// How triangles use an edge; low < high are its vertices.
struct EdgeUse {
    int forward = 0;   // triangles that run from low to high
    int backward = 0;  // triangles that run from high to low

    [[nodiscard]] int count() const { return forward + backward; }
};

/// By edge, in ascending order.
using EdgeUses = std::vector<std::pair<std::pair<int, int>, EdgeUse>>;

EdgeUses collectEdges(const TriangleMesh& mesh);

/// A triangle at the edge between two vertices, low < high.
struct EdgeSide {
    int low = 0;
    int high = 0;
    std::size_t triangle = 0;
    bool forward = false;  // it runs from low to high
};

/// All triangles at all edges: by edge, then in their order.
std::vector<EdgeSide> collectSides(const TriangleMesh& mesh);

/// Calls `visit` with first and last side of each edge, in order.
template <class Visit>
void forEachEdge(const std::vector<EdgeSide>& sides, Visit visit) {
    for (auto first = sides.begin(); first != sides.end();) {
        auto last = first + 1;
        while (last != sides.end() && last->low == first->low && last->high == first->high)
            ++last;
        visit(first, last);
        first = last;
    }
}

/// What hangs together: numbers from 0 in groups, each alone at first.
class Groups {
 public:
    explicit Groups(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    }
    /// The same number for all of a group.
    std::size_t findRoot(std::size_t i) {
        while (parents_[i] != i)
            i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    /// Makes i's group part of j's. False if they are one already.
    bool join(std::size_t i, std::size_t j) {
        const std::size_t root = findRoot(i);
        const std::size_t other = findRoot(j);
        parents_[root] = other;
        return root != other;
    }

 private:
    std::vector<std::size_t> parents_;
};

/// Which triples are the same as one before. Numbers are from 0 to below `limit`.
std::vector<char> findRepeated(const std::vector<Triangle>& triples, std::size_t limit);

/// Whether two corners have the same index, or the three lie on one line exactly.
bool isDegenerate(const TriangleMesh& mesh, const Triangle& triangle);

/// Merges vertices nearer than `tolerance` [m] into the first of them; unused vertices are dropped, triangles
/// are all kept, in their order. Coordinates must be finite.
TriangleMesh weldVertices(const TriangleMesh& mesh, double tolerance);

}  // namespace trapwright::geometry
