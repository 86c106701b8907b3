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

}  // namespace trapwright::geometry
