#pragma once

#include <vector>

#include "core/base/math.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::contact {

/// A triangle of the track, ready for points to be tested against it.
struct TrackTriangle {
    base::Vec3 corner;         // any of its vertices [m]
    base::Vec3 normal;         // outward, unit
    base::Vec3 edgeNormal[3];  // in its plane, unit, pointing out of the triangle
    double edgeOffset[3];  // edgeNormal . p <= edgeOffset inside; slack at valleys and flat edges included,
                           // at ridges something taken off (scalar::kBorder)
    double ridges[3];      // kFar at sides that are strictly convex edges, else 0 (meetsTriangle) [m]
    base::Vec3 centre;     // of a ball around it [m]
    double radius;
};

/// A strictly convex edge of the track: only these push (decisions.md#contact-features).
struct TrackEdge {
    base::Vec3 from, to;   // [m]; longer where the solid goes on (kCornerSlack)
    base::Vec3 direction;  // unit
    base::Vec3 into[2];    // in the planes of its two triangles, unit, pointing from the edge into them
    base::Vec3 outward;    // mean of the two normals, unit
    base::Vec3 centre;     // of a ball around it [m]
    double radius;
};

/// A vertex at which at least one strictly convex edge ends.
struct TrackVertex {
    base::Vec3 position;
    int firstEdge, edgeCount;  // its edges' directions away from it, in ContactTrack::vertexEdges
};

/// A closed triangle mesh prepared for contact detection. Immutable; shared by all trials of a batch.
struct ContactTrack {
    std::vector<TrackTriangle> triangles;
    std::vector<TrackEdge> edges;
    std::vector<TrackVertex> vertices;
    std::vector<base::Vec3> vertexEdges;  // unit
};

/// Edges whose faces meet at less than this beyond flat do not act: treating flat edges as ridges makes parts
/// jump.
inline constexpr double kConvexAngle = 2.0 * base::kDegree;
/// How far beyond a flat edge a triangle's plane still acts, so that no point slips between two. [m]
inline constexpr double kEdgeSlack = 20e-6;
/// How far a flank acts beyond its valley, and a ridge of the track or an edge of the part beyond its end
/// where what lies there is inside the solid, as at the foot of a slope. What comes into the corner of two
/// flanks or ridges is nearest to both beyond where they end, by as much as it is too deep, and would slip
/// between them; and what comes to it fast has to be seen a step before. [m]
inline constexpr double kCornerSlack = 0.1e-3;

/// Farther than any vertex of a part is from a triangle that it is near to. [m]
inline constexpr double kFar = 1e3;

/// Prepares a closed, oriented mesh. Degenerate triangles are left out.
ContactTrack prepareTrack(const geometry::TriangleMesh& mesh);

}  // namespace trapwright::contact
