#pragma once

#include <vector>

#include "core/base/math.h"
#include "core/geometry/convex_polytope.h"

namespace trapwright::geometry {

/// The widest gap between two convex bodies along the normal of a face of either or across an edge of each
/// (Gottschalk, Lin and Manocha 1996): positive exactly if they are apart, and then at most their distance;
/// of bodies that overlap, less its negative is needed to take them apart. Poses: to any common frame. [m]
double calcSeparation(const ConvexPolytope& a, const base::Pose& poseA, const ConvexPolytope& b,
                      const base::Pose& poseB);

/// Whether every piece of one body is at least so far from every piece of another, as calcSeparation tells.
bool areApart(const std::vector<ConvexPolytope>& a, const base::Pose& poseA,
              const std::vector<ConvexPolytope>& b, const base::Pose& poseB, double clearance);

}  // namespace trapwright::geometry
