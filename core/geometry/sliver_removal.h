#pragma once

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Takes out what rounding leaves where faces of united solids nearly lie on each other: steps, gaps and
/// triangles lower than `tolerance` [m]. Corners nearer to each other merge; a triangle with a corner on its
/// longest edge goes, and its neighbour there is cut at that corner; sheets that lie on each other back to
/// back go. Each of these keeps every edge with as many triangles along it one way as the other. With a
/// part of the tolerance, where flat triangles would be cut without end; the mesh as it is, if that does not
/// help or its volume would change by more than a millionth.
TriangleMesh removeSlivers(const TriangleMesh& mesh, double tolerance);

}  // namespace trapwright::geometry
