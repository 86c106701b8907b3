#pragma once

#include <vector>

#include "core/base/math.h"

namespace trapwright::geometry {

/// A face of a convex polytope: the points p with normal . p = offset, polytope on the side normal . p <=
/// offset.
struct PolytopeFace {
    base::Vec3 normal;      // outward, unit
    double offset;          // [m]
    std::vector<int> loop;  // vertex indices, counter-clockwise seen from outside
};

/// An edge between two faces: from -> to has face left on its left seen from outside.
struct PolytopeEdge {
    int from, to;
    int left, right;  // face indices
};

/// A convex body with coplanar triangles merged into polygons.
struct ConvexPolytope {
    std::vector<base::Vec3> vertices;  // [m]
    std::vector<PolytopeFace> faces;
    std::vector<PolytopeEdge> edges;
};

}  // namespace trapwright::geometry
