#pragma once

#include <cstddef>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// A surface of fewer triangles and how far it is from the one that it stands for.
struct SimplifiedSurface {
    TriangleMesh mesh;       // its corners are corners of the given surface
    double deviation = 0.0;  // the farthest that any corner of the given surface is off it [m]
};

/// Collapses edges (quadric error, Garland and Heckbert 1997, through meshoptimizer) until at most
/// `triangles` are left, or until more would move the surface by about `tolerance` [m], which the measured
/// deviation may pass a little. A closed surface stays closed. The mesh must be welded.
SimplifiedSurface simplifySurface(const TriangleMesh& mesh, std::size_t triangles, double tolerance);

}  // namespace trapwright::geometry
