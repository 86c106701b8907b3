#pragma once

#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// What a printer can do.
struct PrintLimits {
    double thinnestWall = 1.2e-3;                    // [m]; three lines of a nozzle of 0.4 mm
    double steepestOverhang = 45.0 * base::kDegree;  // from upright; 90 degrees is a ceiling [rad]
    base::Vec3 direction = {0.0, 0.0, 1.0};          // in which layer is put on layer; a unit vector

    friend bool operator==(const PrintLimits&, const PrintLimits&) = default;
};

/// Neighbouring triangles that a printer may fail at.
struct PrintFlaw {
    std::vector<int> triangles;              // of the mesh
    double worst = 0.0;                      // least thickness [m], or greatest angle from upright [rad]
    double area = 0.0;                       // of what is concerned of the triangles [m^2]
    base::Vec3 centre = base::Vec3::Zero();  // [m]
};

/// A solid as a printer sees it.
struct PrintReport {
    double volume = 0.0;                   // [m^3]
    base::Vec3 size = base::Vec3::Zero();  // of its box [m]
    bool closed = false;                   // closed, manifold and oriented outward
    int overlappingTriangles = 0;          // that cross others
    std::vector<PrintFlaw> thinWalls;      // largest area first
    std::vector<PrintFlaw> overhangs;      // likewise; what lies on the printer's bed is none
};

/// Looks a solid over before it is printed. Walls and overhangs are only told of closed ones.
PrintReport checkForPrinting(const TriangleMesh& mesh, const PrintLimits& limits);

}  // namespace trapwright::geometry
