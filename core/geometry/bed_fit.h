#pragma once

#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Where a printer prints: a box over its bed.
struct BuildSpace {
    double x = 0.25;       // [m]
    double y = 0.21;       // [m]
    double height = 0.22;  // [m]

    friend bool operator==(const BuildSpace&, const BuildSpace&) = default;
};

/// How a solid that stands as it is lies best on a bed.
struct BedFit {
    bool fits = false;
    double turn = 0.0;                       // about the upright axis, in [0, pi) [rad]
    base::Vec3 size = base::Vec3::Zero();    // of the box around the turned solid [m]
    base::Vec3 excess = base::Vec3::Zero();  // how much of it does not fit, by axis; 0 where it does [m]
};

/// The convex hull of what the vertices are above, counter-clockwise (Andrew 1979).
std::vector<base::Vec2> computeFootprint(const TriangleMesh& mesh);

/// Leaves the solid as it is if it fits so, or turns it by a quarter if it fits so. Otherwise turns it about
/// the upright axis so that it fills as little of the bed as it can: the larger of the two shares of the
/// bed's sides is least. Exact: between two turns at which an edge of the footprint lies along a side of the
/// bed both sizes are concave in the angle, so the least of the larger one is at such a turn or where the two
/// shares are equal.
BedFit fitOnBed(const TriangleMesh& mesh, const BuildSpace& space);

}  // namespace trapwright::geometry
