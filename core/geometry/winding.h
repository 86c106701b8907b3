#pragma once

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// How many times the mesh winds around the point: 1 inside a closed, outward oriented mesh, 0 outside;
/// between them for an open one. The sum of the triangles' solid angles over 4 pi (Jacobson et al. 2013, with
/// the solid angle of Van Oosterom and Strackee 1983).
double calcWindingNumber(const TriangleMesh& mesh, const base::Vec3& point);

}  // namespace trapwright::geometry
