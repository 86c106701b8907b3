#include "sim/native/packed_body.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "sim/native/near_pairs.h"

namespace trapwright::native {

using base::Vec3;

namespace {

void set(FloatRows& rows, int firstRow, int column, const Vec3& value) {
    for (int k = 0; k < 3; ++k)
        rows.row(firstRow + k)[column] = static_cast<float>(value[k]);
}

/// Added to balls, so that what floats round away lets no feature out of them. [m]
constexpr double kBallReserve = 1e-6;
constexpr int kBallRows = 4;

struct Ball {
    Vec3 centre;
    double radius;
};

void setBall(FloatRows& balls, int column, const Ball& ball) {
    set(balls, 0, column, ball.centre);
    balls.row(3)[column] = static_cast<float>(ball.radius);
}

FloatRows makeBalls(int count) {
    FloatRows balls(kBallRows, count);
    // However large, a ball of such a radius is near nothing.
    std::fill_n(balls.row(3), balls.stride(), -1e6F);
    return balls;
}

/// A vertex, or an edge with both its ends.
struct Feature {
    Vec3 from, to;
    std::uint32_t piece, index;
    std::uint32_t marks;  // kManyEdges, of a vertex that has them

    [[nodiscard]] Vec3 middle() const { return 0.5 * (from + to); }
};

Ball ballAround(std::span<const Feature> features) {
    Ball ball{Vec3::Zero(), 0.0};
    for (const Feature& feature : features)
        ball.centre += feature.middle() / static_cast<double>(features.size());
    for (const Feature& feature : features) {
        for (const Vec3& end : {feature.from, feature.to})
            ball.radius = std::max(ball.radius, (end - ball.centre).norm() + kBallReserve);
    }
    return ball;
}

/// Halves features across the longest side of their middles' box until each part fits into a group.
void split(std::span<Feature> features, std::vector<std::span<Feature>>& groups) {
    if (features.size() <= kWidestVector) {
        if (!features.empty()) groups.push_back(features);
        return;
    }
    Vec3 low = features.front().middle();
    Vec3 high = low;
    for (const Feature& feature : features) {
        low = low.cwiseMin(feature.middle());
        high = high.cwiseMax(feature.middle());
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    std::ranges::sort(features, {}, [axis](const Feature& feature) {
        return std::tuple(feature.middle()[axis], feature.piece, feature.index);
    });
    const auto half = static_cast<std::size_t>(padToVectors(static_cast<int>(features.size()) / 2));
    split(features.first(half), groups);
    split(features.subspan(half), groups);
}

/// `rowsOf`: where a piece has them.
FeatureGroups group(std::vector<Feature> features, const std::vector<PackedPiece>& pieces,
                    const FloatRows PackedPiece::*rowsOf, int rows) {
    std::vector<std::span<Feature>> found;
    split(features, found);
    const int count = static_cast<int>(found.size());
    FeatureGroups groups;
    groups.balls = makeBalls(count);
    groups.features = FloatRows(rows, count * kWidestVector);
    groups.pieces.resize(static_cast<std::size_t>(count) * kWidestVector);
    groups.indices.resize(groups.pieces.size());
    for (int g = 0; g < count; ++g) {
        const std::span<const Feature> own = found[static_cast<std::size_t>(g)];
        groups.counts.push_back(static_cast<int>(own.size()));
        setBall(groups.balls, g, ballAround(own));
        for (int i = 0; i < kWidestVector; ++i) {
            const Feature& feature = own[std::min<std::size_t>(i, own.size() - 1)];
            const int column = g * kWidestVector + i;
            groups.pieces[static_cast<std::size_t>(column)] = feature.piece;
            groups.indices[static_cast<std::size_t>(column)] = feature.index | feature.marks;
            for (int r = 0; r < rows; ++r)
                groups.features.row(r)[column] = (pieces[feature.piece].*rowsOf).row(r)[feature.index];
        }
    }
    return groups;
}

PackedPiece pack(const contact::BodyPiece& piece) {
    PackedPiece packed{};
    for (int k = 0; k < 3; ++k)
        packed.centre[k] = static_cast<float>(piece.centre[k]);
    packed.radius = static_cast<float>(piece.radius);

    packed.vertexCount = static_cast<int>(piece.vertices.size());
    packed.vertices = FloatRows(3, packed.vertexCount);
    packed.firstEdge.push_back(0);
    for (int v = 0; v < packed.vertices.stride(); ++v) {
        const bool padding = v >= packed.vertexCount;
        const contact::BodyVertex& vertex = piece.vertices[padding ? 0 : v];
        set(packed.vertices, 0, v, vertex.position);
        if (padding) continue;
        for (int e = 0; e < vertex.edgeCount; ++e) {
            for (int k = 0; k < 3; ++k)
                packed.vertexEdges.push_back(static_cast<float>(piece.vertexEdges[vertex.firstEdge + e][k]));
        }
        packed.firstEdge.push_back(packed.firstEdge.back() + vertex.edgeCount);
        for (int k = 0; k < 3; ++k)
            packed.vertexFields.push_back(static_cast<float>(vertex.position[k]));
        for (int e = 0; e < kConeEdges; ++e) {
            const bool hasMore = vertex.edgeCount > kConeEdges;
            const Vec3 away = hasMore
                                  ? Vec3(Vec3::Zero())
                                  : piece.vertexEdges[vertex.firstEdge + std::min(e, vertex.edgeCount - 1)];
            for (int k = 0; k < 3; ++k)
                packed.vertexFields.push_back(static_cast<float>(away[k]));
        }
    }

    const int edgeCount = static_cast<int>(piece.edges.size());
    packed.edges = FloatRows(kEdgeRows, edgeCount);
    for (int e = 0; e < packed.edges.stride(); ++e) {
        const contact::BodyEdge& edge = piece.edges[e < edgeCount ? e : 0];
        set(packed.edges, kFromX, e, edge.from);
        set(packed.edges, kDirectionX, e, edge.direction);
        set(packed.edges, kInto0X, e, edge.into[0]);
        set(packed.edges, kInto1X, e, edge.into[1]);
        // No point lies within an edge of negative length.
        packed.edges.row(kLength)[e] = e < edgeCount ? static_cast<float>(edge.length) : -1.0F;
    }

    const int faceCount = static_cast<int>(piece.faces.size());
    packed.faces = FloatRows(kFaceRows, faceCount);
    for (int f = 0; f < packed.faces.stride(); ++f) {
        const contact::BodyFace& face = piece.faces[f < faceCount ? f : 0];
        set(packed.faces, kFaceNormalX, f, face.normal);
        const double offset = face.offset + (face.isCut ? contact::kCutSlack : 0.0);
        packed.faces.row(kPlaneOffset)[f] = f < faceCount ? static_cast<float>(-offset) : -1e6F;
        packed.faces.row(kCountsFrom)[f] = face.isCut ? 0.0F : -1e9F;
    }
    return packed;
}

}  // namespace

PackedBody::PackedBody(const contact::ContactBody& body)
    : centre{}, reach(0.0F), radius(static_cast<float>(body.radius)) {
    std::vector<Feature> ofVertices;
    std::vector<Feature> ofEdges;
    Vec3 middle = Vec3::Zero();
    for (const contact::BodyPiece& piece : body.pieces) {
        const auto number = static_cast<std::uint32_t>(pieces.size());
        for (std::uint32_t v = 0; v < piece.vertices.size(); ++v)
            ofVertices.push_back({piece.vertices[v].position, piece.vertices[v].position, number, v,
                                  piece.vertices[v].edgeCount > kConeEdges ? kManyEdges : 0U});
        for (std::uint32_t e = 0; e < piece.edges.size(); ++e)
            ofEdges.push_back({piece.edges[e].from, piece.edges[e].to, number, e, 0U});
        middle += piece.centre / static_cast<double>(body.pieces.size());
        pieces.push_back(pack(piece));
    }
    vertices = group(std::move(ofVertices), pieces, &PackedPiece::vertices, 3);
    edges = group(std::move(ofEdges), pieces, &PackedPiece::edges, kEdgeRows);
    for (int k = 0; k < 3; ++k)
        centre[k] = static_cast<float>(middle[k]);
    for (const contact::BodyPiece& piece : body.pieces) {
        const double farthest = (piece.centre - middle).norm() + piece.radius + kBallReserve;
        reach = std::max(reach, static_cast<float>(farthest));
    }
}

}  // namespace trapwright::native
