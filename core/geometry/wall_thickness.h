#pragma once

#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// How far it is from each triangle to the face behind it [m]: the shortest of the ways straight inward from
/// points spread over the triangle. Only faces nearly parallel to the triangle count, within 45 degrees: what
/// is near a blunt edge is no wall. Infinite where there is none nearer than `farthest`. The mesh must be
/// closed and oriented outward. Through CGAL.
std::vector<double> measureWalls(const TriangleMesh& mesh, double farthest);

}  // namespace trapwright::geometry
