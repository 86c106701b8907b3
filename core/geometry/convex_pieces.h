#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/geometry/convex_polytope.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Convex pieces that do not overlap and whose union is the solid: one piece, its hull, if it is convex.
/// The pieces serve for contact, so they are never fatter than the solid by more than 0.1 % of its volume
/// (rounding of merges), and lack no more than 1 % of it. Hollows and inner corners stay free.
///
/// `mesh` must be closed and outward oriented (repairMesh); its coordinates may carry the noise of single
/// precision. The solid is cut by planes of its own faces, those first that cut the fewest triangles, until
/// no face of a piece has any surface in front of it by more than a depth tolerance (as in the decomposition
/// by notches of Chazelle 1984, but with a tolerance); then neighbours whose hull adds next to nothing are
/// merged. The tolerance is 0.05 % of the size; finer, down to 0.002 %, where too much volume would be lost;
/// coarser, up to 0.5 %, where it takes too many pieces. Finely tessellated concave surfaces need a piece for
/// each facet. Error: the mesh encloses no volume, crosses itself (with the place), or is too fine or too
/// involved for 384 pieces; computeContactShape then knows what to do.
base::Result<std::vector<ConvexPolytope>> computeConvexPieces(const TriangleMesh& mesh);

/// Merges convex pieces that do not overlap, cheapest pair first, as long as the hull of two is larger than
/// both together by no more than 1 % of the smaller and all merges together have added no more than
/// `tolerance` [m^3]. Few pieces make contact detection quick, but every merge makes the part a little
/// fatter.
std::vector<ConvexPolytope> mergePieces(std::vector<ConvexPolytope> pieces, double tolerance);

}  // namespace trapwright::geometry
