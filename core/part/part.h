#pragma once

#include <string>
#include <vector>

#include "core/geometry/convex_polytope.h"
#include "core/geometry/mass_properties.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::part {

/// The rotations that map a part onto itself. Rotations are about the centre of mass, in the part frame.
struct SymmetryGroup {
    std::string name = "C1";  // Schoenflies: C1, C2, D2, D4, C6, T, O, I; Cinf, Dinf; SO3 (sphere)
    std::vector<base::Quaternion> rotations = {
        base::Quaternion::Identity()};      // the finite group, identity first
    bool continuous = false;                // any rotation about `axis` maps the part onto itself
    base::Vec3 axis = base::Vec3::UnitZ();  // of a continuous group [unit]
    bool flip = false;                      // continuous group: the axis's two ends are alike (Dinf)
    bool sphere = false;                    // any rotation at all
};

/// An orientation in which the part rests on a horizontal plane. Heading about the vertical is free.
struct StablePose {
    base::Quaternion rotation;  // part frame to world, z up
    double height = 0.0;        // of the centre of mass above the plane [m]
    double probability = 0.0;
    int multiplicity = 1;  // hull faces that are alike under the symmetry and were merged into this pose
};

/// The rigid body being fed. The part frame has the file's axes and its origin at the centre of mass.
struct Part {
    std::string name;
    std::string source;                       // file it came from
    double density = 0.0;                     // [kg/m^3]
    geometry::TriangleMesh mesh;              // closed, oriented [m]
    geometry::MassProperties massProperties;  // centre = 0 in this frame
    geometry::ConvexPolytope hull;
    std::vector<geometry::ConvexPolytope>
        pieces;  // their union is the part; one piece, equal to the hull, if convex
    SymmetryGroup symmetry;
    std::vector<StablePose> stablePoses;  // most probable first
    double boundingRadius = 0.0;          // about the origin [m]
};

}  // namespace trapwright::part
