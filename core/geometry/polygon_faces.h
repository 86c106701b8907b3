#pragma once

#include <optional>

#include "core/geometry/convex_polytope.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Turns the closed, outward oriented triangle mesh of a convex body into a polytope: triangles that lie in
/// one plane to within `tolerance` [m] become one polygon, vertices between only two faces are dropped, edges
/// are filled in. None where merging with this tolerance does not leave a polytope (nearly round bodies with
/// tiny facets).
std::optional<ConvexPolytope> mergeCoplanarTriangles(const TriangleMesh& mesh, double tolerance);

}  // namespace trapwright::geometry
