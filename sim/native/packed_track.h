#pragma once

#include <vector>

#include "sim/contact/contact_track.h"
#include "sim/native/aligned.h"

namespace trapwright::native {

/// Balls: centre and radius, one array each, padded with balls that are near nothing. [m]
struct BallArrays {
    AlignedVector<float> x, y, z, radius;
    int count = 0;

    void add(const base::Vec3& centre, double ballRadius);
    void pad();
};

/// Balls around features of a track, in the order of the features, and around each kWidestVector of these.
struct FeatureBalls {
    BallArrays balls, blocks;

    void pad();
};

/// A track triangle: its plane and those of its three sides, through its corner. Differences to the corner
/// are taken in double, what is left fits into floats.
struct PackedTriangle {
    double corner[3];  // [m]
    alignas(16) float nx[4];
    alignas(16) float ny[4];
    alignas(16) float nz[4];
    alignas(16) float offset[4];  // normal . (p - corner) + offset: how far p is beyond
    float ridges[3];              // contact::TrackTriangle
};

struct PackedEdge {
    double from[3];  // [m]
    float length;    // [m]
    alignas(16) float direction[4];
    alignas(16) float outward[4];
    alignas(16) float into[2][4];
};

struct PackedVertex {
    double position[3];        // [m]
    int firstEdge, edgeCount;  // in PackedTrack::vertexEdges
};

/// contact::ContactTrack as the kernel reads it.
struct PackedTrack {
    explicit PackedTrack(const contact::ContactTrack& track);

    std::vector<PackedTriangle> triangles;
    std::vector<PackedEdge> edges;
    std::vector<PackedVertex> vertices;
    std::vector<float> vertexEdges;  // three each
    FeatureBalls triangleBalls, edgeBalls, vertexBalls;
    // The triangles' planes side by side, in the track's frame: normal and offset of each of the four, padded
    // with triangles that nothing is near.
    FloatRows planes;
};

}  // namespace trapwright::native
