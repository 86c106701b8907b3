#pragma once

#include <map>
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

using EdgeUses = std::map<std::pair<int, int>, EdgeUse>;

EdgeUses collectEdges(const TriangleMesh& mesh);

/// Whether two corners have the same index, or the three lie on one line exactly.
bool isDegenerate(const TriangleMesh& mesh, const Triangle& triangle);

/// Merges vertices nearer than `tolerance` [m] into the first of them; unused vertices are dropped, triangles
/// are all kept, in their order. Coordinates must be finite.
TriangleMesh weldVertices(const TriangleMesh& mesh, double tolerance);

/// A set of triangles that hang together through common edges.
struct Shell {
    std::vector<std::size_t> triangles;
    double volume = 0.0;  // [m^3], negative if inside out
    int depth = 0;        // number of other shells around it: odd for the wall of a cavity

    /// Whether its orientation fits its depth: solid inside, or cavity inside.
    [[nodiscard]] bool isRightWayOut() const { return (depth % 2 == 0) == (volume >= 0.0); }
};

/// The shells in the order of their first triangles. Volumes and depths mean something for closed,
/// consistently oriented shells that do not cross each other.
std::vector<Shell> findShells(const TriangleMesh& mesh);

}  // namespace trapwright::geometry
