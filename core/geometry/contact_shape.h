#pragma once

#include <cstddef>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/convex_polytope.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// What a solid touches with: exactly its surface where that is simple enough, a simpler one near it
/// otherwise.
struct ContactShape {
    ConvexPolytope hull;
    std::size_t exactCorners = 0;  // of the exact hull; as many as `hull` has if that is it
    double hullDeviation = 0.0;    // the farthest that the exact hull reaches out of `hull` [m]

    std::vector<ConvexPolytope> pieces;  // without overlap; one, equal to the hull, if the solid is convex
    std::size_t triangles = 0;           // of the simplified surface that they were made of; 0 if it was not
    double deviation = 0.0;  // the farthest that pieces or simplified surface were found off the solid's [m]
};

/// Hull and convex pieces for contact. A hull of more than 4000 corners is simplified to within about 0.1 %
/// of the size. Pieces are those of computeConvexPieces if there are not too many of them; otherwise of a
/// surface simplified to within about 0.1 % of the size (simplifySurface), as hulls of few corners that reach
/// out of it a little (computeNearConvexPieces, 0.2 % of the size where 192 pieces will do, never more than
/// 1 %), and leave corners out that are no more than another 0.05 % outside them. `mesh` must be closed and
/// outward oriented. Errors: it encloses no volume, crosses itself (with the place), is too involved.
base::Result<ContactShape> computeContactShape(const TriangleMesh& mesh);

}  // namespace trapwright::geometry
