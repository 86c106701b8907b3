#pragma once

#include <span>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// A hull of some of the points.
struct ThinnedHull {
    TriangleMesh mesh;
    double shortfall = 0.0;  // the farthest that any of the points is outside [m]
};

/// The convex hull of few of the points: of those farthest out, then of more, those farthest from the hull so
/// far, until none is farther outside than `tolerance` [m]. Depends on the set of points only. Error: they do
/// not span a volume.
base::Result<ThinnedHull> thinHull(std::span<const base::Vec3> points, double tolerance);

}  // namespace trapwright::geometry
