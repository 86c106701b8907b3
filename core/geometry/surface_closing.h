#pragma once

#include "core/base/result.h"
#include "core/geometry/mesh_check.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// A surface whose triangles agree on their sides, and the holes that were closed to get it.
struct ClosedSurface {
    TriangleMesh mesh;  // the given triangles in their order, some turned around, then the filled holes
    std::vector<MeshHole> filled;
};

/// Makes neighbouring triangles agree on their orientation (Gueziec et al. 2001), separates sheets that meet
/// in an edge of more than two triangles, and fills holes whose perimeter is at most `largestPerimeter` [m]
/// with triangles of least area (Liepa 2003). Through CGAL. `mesh` must be welded, without degenerate and
/// duplicate triangles. Larger holes stay; look with checkMesh. Error: CGAL gave up.
base::Result<ClosedSurface> closeSurface(const TriangleMesh& mesh, double largestPerimeter);

}  // namespace trapwright::geometry
