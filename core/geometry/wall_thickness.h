#pragma once

#include <limits>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// What lies behind a triangle.
struct Wall {
    double thickness = std::numeric_limits<double>::infinity();  // the least [m]
    double share = 0.0;  // of the triangle that has such a face behind it
};

/// How far it is from each triangle to the face behind it, up to `farthest` [m]: the shortest of the ways
/// straight inward from points spread over the triangle. Only faces nearly parallel to the triangle count,
/// within 45 degrees: what is near a blunt edge is no wall. The mesh must be closed and oriented outward.
/// Through CGAL.
std::vector<Wall> measureWalls(const TriangleMesh& mesh, double farthest);

}  // namespace trapwright::geometry
