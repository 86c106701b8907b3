#pragma once

#include <array>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// A small piece of the surface of a solid with its other side close behind it.
struct WallCell {
    int triangle = 0;                   // of the mesh
    std::array<base::Vec3, 3> corners;  // a part of the triangle [m]
    double area = 0.0;                  // [m^2]
    double thickness = 0.0;             // straight inward from the middle to the other side [m]

    [[nodiscard]] base::Vec3 middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }
};

/// Where a solid is thinner than `thinnest` [m]. The surface is cut into cells of about a millimetre,
/// and from the middle of each a ray goes straight inward (the shape diameter of Shapira, Shamir and Cohen-Or
/// 2008 with one ray): the first face it leaves through is the wall's other side if the two enclose less than
/// 45 degrees. The mesh must be closed and oriented outward. Through CGAL.
std::vector<WallCell> findThinCells(const TriangleMesh& mesh, double thinnest);

/// An edge at which the solid comes to a point.
struct SharpEdge {
    int from = 0;  // vertices of the mesh
    int to = 0;
    double angle = 0.0;  // inside the solid, between the two faces [rad]
};

/// The edges that enclose less than `widest` [rad] inside the solid.
std::vector<SharpEdge> findSharpEdges(const TriangleMesh& mesh, double widest);

}  // namespace trapwright::geometry
