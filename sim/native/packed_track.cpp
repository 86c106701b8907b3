#include "sim/native/packed_track.h"

#include <algorithm>

namespace trapwright::native {

using base::Vec3;

namespace {

void copy(const Vec3& from, float* to) {
    for (int k = 0; k < 3; ++k)
        to[k] = static_cast<float>(from[k]);
}

void copy(const Vec3& from, double* to) {
    for (int k = 0; k < 3; ++k)
        to[k] = from[k];
}

PackedTriangle pack(const contact::TrackTriangle& triangle) {
    PackedTriangle packed{};
    copy(triangle.corner, packed.corner);
    const auto setPlane = [&](int k, const Vec3& normal, double offset) {
        packed.nx[k] = static_cast<float>(normal.x());
        packed.ny[k] = static_cast<float>(normal.y());
        packed.nz[k] = static_cast<float>(normal.z());
        packed.offset[k] = static_cast<float>(offset);
    };
    setPlane(0, triangle.normal, 0.0);
    for (int c = 0; c < 3; ++c) {
        setPlane(1 + c, triangle.edgeNormal[c],
                 triangle.edgeNormal[c].dot(triangle.corner) - triangle.edgeOffset[c]);
        packed.ridges[c] = static_cast<float>(triangle.ridges[c]);
    }
    return packed;
}

PackedEdge pack(const contact::TrackEdge& edge) {
    PackedEdge packed{};
    copy(edge.from, packed.from);
    packed.length = static_cast<float>(2.0 * edge.radius);
    copy(edge.direction, packed.direction);
    copy(edge.outward, packed.outward);
    copy(edge.into[0], packed.into[0]);
    copy(edge.into[1], packed.into[1]);
    return packed;
}

}  // namespace

void BallArrays::add(const Vec3& centre, double ballRadius) {
    x.push_back(static_cast<float>(centre.x()));
    y.push_back(static_cast<float>(centre.y()));
    z.push_back(static_cast<float>(centre.z()));
    radius.push_back(static_cast<float>(ballRadius));
    ++count;
}

void BallArrays::pad() {
    constexpr float kFar = 1e6F;
    const auto size = static_cast<std::size_t>(padToVectors(count));
    for (AlignedVector<float>* array : {&x, &y, &z})
        array->resize(size, kFar);
    radius.resize(size, 0.0F);
}

void FeatureBalls::pad() {
    // What floats round away lets no ball out of its block. [m]
    constexpr double kReserve = 1e-6;
    for (int first = 0; first < balls.count; first += kWidestVector) {
        const int end = std::min(first + kWidestVector, balls.count);
        const auto centreOf = [&](int i) { return Vec3(balls.x[i], balls.y[i], balls.z[i]); };
        Vec3 centre = Vec3::Zero();
        for (int i = first; i < end; ++i)
            centre += centreOf(i) / (end - first);
        double radius = 0.0;
        for (int i = first; i < end; ++i)
            radius = std::max(radius, (centreOf(i) - centre).norm() + balls.radius[i] + kReserve);
        blocks.add(centre, radius);
    }
    balls.pad();
    blocks.pad();
}

PackedTrack::PackedTrack(const contact::ContactTrack& track) {
    for (const contact::TrackTriangle& triangle : track.triangles) {
        triangles.push_back(pack(triangle));
        triangleBalls.balls.add(triangle.centre, triangle.radius);
    }
    for (const contact::TrackEdge& edge : track.edges) {
        edges.push_back(pack(edge));
        edgeBalls.balls.add(edge.centre, edge.radius);
    }
    for (const contact::TrackVertex& vertex : track.vertices) {
        PackedVertex packed{{}, vertex.firstEdge, vertex.edgeCount};
        copy(vertex.position, packed.position);
        vertices.push_back(packed);
        vertexBalls.balls.add(vertex.position, 0.0);
    }
    for (const Vec3& direction : track.vertexEdges) {
        for (int k = 0; k < 3; ++k)
            vertexEdges.push_back(static_cast<float>(direction[k]));
    }
    const int count = static_cast<int>(track.triangles.size());
    planes = FloatRows(16, count);
    for (int t = 0; t < planes.stride(); ++t) {
        for (int c = 0; c < 4; ++c) {
            float* offset = &planes.row(4 * c + 3)[t];
            *offset = 1e6F;
            if (t >= count) continue;
            const contact::TrackTriangle& triangle = track.triangles[static_cast<std::size_t>(t)];
            const Vec3& normal = c == 0 ? triangle.normal : triangle.edgeNormal[c - 1];
            for (int k = 0; k < 3; ++k)
                planes.row(4 * c + k)[t] = static_cast<float>(normal[k]);
            *offset = static_cast<float>(c == 0 ? -normal.dot(triangle.corner) : -triangle.edgeOffset[c - 1]);
        }
    }
    for (FeatureBalls* balls : {&triangleBalls, &edgeBalls, &vertexBalls})
        balls->pad();
}

}  // namespace trapwright::native
