#pragma once

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Of a homogeneous solid. Inertia is about the centre of mass, in the mesh's axes.
struct MassProperties {
    double volume = 0.0;                      // [m^3]
    double area = 0.0;                        // [m^2]
    double mass = 0.0;                        // [kg]
    base::Vec3 centre = base::Vec3::Zero();   // centre of mass [m]
    base::Mat3 inertia = base::Mat3::Zero();  // [kg m^2]
};

/// Exact polyhedral integrals of a closed, oriented mesh as a sum of signed tetrahedra (divergence theorem;
/// Eberly, "Polyhedral Mass Properties", 2002); density in kg/m^3. An inside-out mesh gives a negative
/// volume, an empty one zeros; an open one gives numbers without meaning.
MassProperties calcMassProperties(const TriangleMesh& mesh, double density);

}  // namespace trapwright::geometry
