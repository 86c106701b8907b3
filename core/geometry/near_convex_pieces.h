#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/geometry/convex_polytope.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Convex pieces that cover a solid nearly and reach a little out of it.
struct NearConvexPieces {
    std::vector<ConvexPolytope> pieces;  // without overlap
    double excess = 0.0;                 // the farthest that a piece was found to reach out of the solid [m]
    double shortfall = 0.0;              // the farthest that the solid reaches out of the pieces [m]
};

/// Cuts space into convex cells until the hull of the solid inside each reaches out of the solid by no more
/// than `tolerance` [m], the worst cell first (top down, as V-HACD and CoACD do, but with the excess measured
/// on the hulls), or until there are `mostPieces`; the excess then tells how good that is. Cuts are planes
/// through the deepest hollow: along the axes, along the surface there, across the hollow; that which leaves
/// the least hull volume. So a ring falls into sectors and a turned part into slices and sectors. A piece is
/// the hull of few of its corners (thinHull): the others are outside it by no more than `thinning` [m].
/// Error: the mesh has no volume.
base::Result<NearConvexPieces> computeNearConvexPieces(const TriangleMesh& mesh, double tolerance,
                                                       double thinning, std::size_t mostPieces);

}  // namespace trapwright::geometry
