#pragma once

#include <span>

#include "core/base/result.h"
#include "core/geometry/convex_polytope.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// The convex hull (quickhull with exact predicates, through CGAL). Neighbouring triangles whose corners lie
/// in one plane to within 1e-6 of the size are merged into one polygon, and vertices inside such a face or on
/// such an edge are dropped. The result depends on the set of points only, not on their order. Error: a
/// coordinate is not finite, or the points do not span a volume (fewer than 4 that are not in one plane).
base::Result<ConvexPolytope> computeConvexHull(std::span<const base::Vec3> points);

/// The same hull as triangles: quicker, for weighing many. Faces of more corners, exactly plane ones, are
/// fans from their lowest corners; so the triangles, too, depend on the set of points only.
base::Result<TriangleMesh> computeHullMesh(std::span<const base::Vec3> points);

/// Of such triangles the polytope. Error: no clean faces.
base::Result<ConvexPolytope> mergeHullFaces(const TriangleMesh& hull);

/// Whether points do span a volume. Their coordinates must be finite.
bool doSpanVolume(std::span<const base::Vec3> points);

/// The convex hull of the vertices that triangles of `mesh` use.
base::Result<ConvexPolytope> computeConvexHull(const TriangleMesh& mesh);

/// The polytope's surface as a closed, outward oriented mesh: each face a fan of triangles.
TriangleMesh toMesh(const ConvexPolytope& polytope);

/// Whether the solid fills its convex hull to within relativeTolerance of the hull's volume. False for a mesh
/// that has no hull.
bool isConvex(const TriangleMesh& mesh, double relativeTolerance);

/// Whether the point is in the polytope or nearer than `margin` to being so, face by face. [m]
bool contains(const ConvexPolytope& polytope, const base::Vec3& point, double margin = 0.0);

}  // namespace trapwright::geometry
