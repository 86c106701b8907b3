#pragma once

#include <utility>
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

/// A region in which the solid is thinner than the printer's thinnest wall.
struct ThinWall {
    TriangleMesh patch;                      // of both its sides, as parts of the solid's triangles
    double thickness = 0.0;                  // the least [m]
    double area = 0.0;                       // of one side: the mean of both [m^2]
    base::Vec3 centre = base::Vec3::Zero();  // [m]
};

/// A line along which the solid comes to a point that is too sharp to print.
struct SharpRidge {
    std::vector<std::pair<base::Vec3, base::Vec3>> edges;  // that hang together [m]
    double angle = 0.0;                                    // the least between its two faces [rad]
    double length = 0.0;                                   // [m]
    double lost = 0.0;  // how much of its height is thinner than the thinnest wall, at most [m]
    base::Vec3 centre = base::Vec3::Zero();  // [m]
};

/// Neighbouring triangles that hang over.
struct Overhang {
    std::vector<int> triangles;              // of the mesh
    double angle = 0.0;                      // the greatest, from upright [rad]
    double area = 0.0;                       // [m^2]
    base::Vec3 centre = base::Vec3::Zero();  // [m]
};

/// A solid as a printer sees it.
struct PrintReport {
    double volume = 0.0;                   // [m^3]
    base::Vec3 size = base::Vec3::Zero();  // of its box [m]
    bool closed = false;                   // closed, manifold and oriented outward
    int overlappingTriangles = 0;          // that cross others
    std::vector<ThinWall> thinWalls;       // largest area first
    std::vector<SharpRidge> ridges;        // longest first
    std::vector<Overhang> overhangs;       // largest area first; what lies on the printer's bed is none

    /// Whether a printer can make all of a solid that is one.
    [[nodiscard]] bool isPrintable() const {
        return thinWalls.empty() && ridges.empty() && overhangs.empty();
    }
    [[nodiscard]] bool isFlawless() const { return closed && overlappingTriangles == 0 && isPrintable(); }
};

/// Edges of a solid sharper than this are ridges. [rad]
inline constexpr double kSharpestEdge = 45.0 * base::kDegree;

/// Looks a solid over before it is printed. Walls, ridges and overhangs are only told of closed ones. What is
/// thin because it tapers to a ridge is told of as that ridge, with its angle, and is no thin wall.
PrintReport checkForPrinting(const TriangleMesh& mesh, const PrintLimits& limits);

/// What it tells of walls, ridges and overhangs, of a solid that is known to be closed, and nothing else:
/// quick enough to judge tracks by while they are learned.
PrintReport checkClosedForPrinting(const TriangleMesh& mesh, const PrintLimits& limits);
/// Each alone.
std::vector<ThinWall> findThinWalls(const TriangleMesh& mesh, const PrintLimits& limits);
std::vector<SharpRidge> findSharpRidges(const TriangleMesh& mesh, const PrintLimits& limits);
std::vector<Overhang> findOverhangs(const TriangleMesh& mesh, const PrintLimits& limits);

}  // namespace trapwright::geometry
