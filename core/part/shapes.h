#pragma once

#include <span>

#include "core/base/math.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::part {

/// A box around the origin with these edge lengths. [m]
geometry::TriangleMesh makeBox(const base::Vec3& size);

/// The solid between a simple polygon in the x-y plane, counter-clockwise, and its copy at z = depth. The
/// polygon must be star-shaped as seen from its first corner. [m]
geometry::TriangleMesh makePrism(std::span<const base::Vec2> polygon, double depth);

/// The solid of revolution of a profile about the z axis as `facets` flat facets. The profile's points are
/// (radius, z), from one place on the axis (radius 0) to another, with the solid on their left: upwards on
/// the outside. [m]
geometry::TriangleMesh makeTurned(std::span<const base::Vec2> profile, int facets);

}  // namespace trapwright::part
