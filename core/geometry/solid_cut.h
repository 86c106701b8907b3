#pragma once

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// What of a solid is outside another one, or inside it, as a closed manifold (CGAL's corefinement with exact
/// predicates). Both must be closed and oriented outward, and must not cross themselves where their surfaces
/// meet. Triangles that the other's surface does not touch keep their corners bit for bit. An error if there
/// is no such manifold: surfaces that touch in a point or an edge, or cross themselves there.
base::Result<TriangleMesh> subtractSolid(const TriangleMesh& solid, const TriangleMesh& tool);
base::Result<TriangleMesh> intersectSolids(const TriangleMesh& solid, const TriangleMesh& tool);

/// A regular prism about the upright line through `centre`, from z = low to z = high; its corners lie at this
/// radius. `sides` at least 3. [m]
TriangleMesh makeCylinder(const base::Vec2& centre, double radius, double low, double high, int sides);

}  // namespace trapwright::geometry
