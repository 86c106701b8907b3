#pragma once

#include <cstddef>
#include <optional>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// How many of the first `firstTriangles` triangles overlap at least one other of them. Exact predicates
/// (CGAL).
///
/// Two triangles without a common corner overlap if they have any point in common; touching counts, because
/// the surface is then not that of a solid. Corners are common if their coordinates are equal, whatever their
/// indices. Triangles with one common corner overlap if they meet anywhere else; with a common edge if they
/// are folded flat onto each other; with three common corners always. Triangles without area overlap nothing.
/// Coordinates must be finite.
int countOverlappingTriangles(const TriangleMesh& mesh, std::size_t firstTriangles);

/// The middle of a triangle that overlaps another one in the sense above; none if the surface is clean. [m]
std::optional<base::Vec3> findOverlap(const TriangleMesh& mesh);

}  // namespace trapwright::geometry
