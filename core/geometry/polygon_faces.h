#pragma once

#include <optional>
#include <vector>

#include "core/geometry/convex_polytope.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Turns the closed, outward oriented triangle mesh of a convex body into a polytope: triangles that lie in
/// one plane to within `tolerance` [m] become one polygon, vertices between only two faces are dropped, edges
/// are filled in. None where merging with this tolerance does not leave a polytope (nearly round bodies with
/// tiny facets).
std::optional<ConvexPolytope> mergeCoplanarTriangles(const TriangleMesh& mesh, double tolerance);

/// A plane part of a solid's surface.
struct FlatFace {
    base::Vec3 normal = base::Vec3::UnitZ();  // outward, a unit vector
    /// Vertices of the mesh: first the outside, counter-clockwise seen from the front, then the holes,
    /// clockwise.
    std::vector<std::vector<int>> loops;
};

/// The surface of a closed, oriented manifold mesh as plane faces: neighbouring triangles whose corners lie
/// within `tolerance` [m] of one plane become one face, and corners in the middle of a straight edge between
/// two faces are left out. Every edge belongs to two faces, and is run through once in each direction. None
/// if the mesh is not such.
std::optional<std::vector<FlatFace>> mergeFlatFaces(const TriangleMesh& mesh, double tolerance);

}  // namespace trapwright::geometry
