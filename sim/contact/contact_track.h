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
    double edgeOffset[3];  // edgeNormal . p <= edgeOffset inside; slack at concave and flat edges included
    base::Vec3 centre;     // of a ball around it [m]
    double radius;
};

/// A strictly convex edge of the track: only these push (decisions.md#contact-features).
struct TrackEdge {
    base::Vec3 from, to;   // [m]; kEdgeSlack longer where it ends below the surface, at a valley
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
/// How far beyond a flat or concave edge a triangle's plane still acts, so that no point slips between two,
/// and how far beyond the foot of a slope a ridge, so that no edge slips between two halves of a crest. [m]
inline constexpr double kEdgeSlack = 20e-6;

/// Prepares a closed, oriented mesh. Degenerate triangles are left out.
ContactTrack prepareTrack(const geometry::TriangleMesh& mesh);

}  // namespace trapwright::contact
