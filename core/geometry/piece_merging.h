#pragma once

#include <vector>

#include "core/geometry/convex_polytope.h"

namespace trapwright::geometry {

/// Merges convex pieces that do not overlap, cheapest pair first, as long as the hull of two is larger than
/// both together by no more than 1 % of the smaller and all merges together have added no more than
/// `tolerance` [m^3]. Few pieces make contact detection quick, but every merge makes the part a little
/// fatter.
std::vector<ConvexPolytope> mergePieces(std::vector<ConvexPolytope> pieces, double tolerance);

}  // namespace trapwright::geometry
