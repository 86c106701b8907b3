#pragma once

#include <vector>

#include "core/base/math.h"
#include "core/geometry/convex_polytope.h"
#include "core/part/part.h"

namespace trapwright::contact {

struct BodyVertex {
    base::Vec3 position;       // part frame [m]
    int firstEdge, edgeCount;  // its edges' directions away from it, in BodyPiece::vertexEdges
};

struct BodyEdge {
    base::Vec3 from, to;   // without their ends (scalar::kBorder) [m]
    base::Vec3 direction;  // unit
    double length;         // [m]
    base::Vec3 into[2];    // in the planes of its two faces, unit, pointing from the edge into them
};

struct BodyFace {
    base::Vec3 normal;   // outward, unit
    double offset;       // [m]
    bool isCut = false;  // other pieces lie against all of it: nothing is let out there
};

/// What is at most so far beyond a cut is held by the piece's other faces: it is in the corner of two pieces
/// and has to be held by both. [m]
inline constexpr double kCutSlack = 30e-6;

/// One convex piece of a part, with those vertices and edges that are the whole part's (keepUnionFeatures).
struct BodyPiece {
    std::vector<BodyVertex> vertices;
    std::vector<base::Vec3> vertexEdges;
    std::vector<BodyEdge> edges;
    std::vector<BodyFace> faces;
    base::Vec3 centre;  // of a ball around it [m]
    double radius;
};

/// A part prepared for contact detection: the union of its convex pieces.
struct ContactBody {
    std::vector<BodyPiece> pieces;
    double radius = 0.0;  // of a ball around the origin [m]
};

ContactBody prepareBody(const std::vector<geometry::ConvexPolytope>& pieces);

}  // namespace trapwright::contact
