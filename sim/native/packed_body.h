#pragma once

#include <cstdint>
#include <vector>

#include "sim/contact/contact_body.h"
#include "sim/native/aligned.h"

namespace trapwright::native {

/// Rows of PackedPiece::edges.
enum EdgeRow : int {
    kFromX,
    kFromY,
    kFromZ,
    kDirectionX,
    kDirectionY,
    kDirectionZ,
    kLength,
    kInto0X,
    kInto0Y,
    kInto0Z,
    kInto1X,
    kInto1Y,
    kInto1Z,
    kEdgeRows
};

/// Of a face of a piece: normal . p + offset is how far p is beyond, and counts from more than that: of cuts
/// (contact::BodyFace::isCut) 0, their slack being in the offset.
enum FaceRow : int { kFaceNormalX, kFaceNormalY, kFaceNormalZ, kPlaneOffset, kCountsFrom, kFaceRows };

/// One convex piece of a part, features side by side. Padding is such that it never touches anything. [m]
struct PackedPiece {
    float centre[3];
    float radius;
    int vertexCount;
    FloatRows vertices;               // x, y, z
    FloatRows edges;                  // EdgeRow
    FloatRows faces;                  // FaceRow
    std::vector<int> firstEdge;       // of each vertex, in vertexEdges; one more than there are vertices
    std::vector<float> vertexEdges;   // directions away from the vertex, three each
    std::vector<float> vertexFields;  // of each vertex: VertexPairField up to kPlanes
};

/// Features of one kind of all pieces, in groups of at most kWidestVector that lie close together, each in a
/// ball: of a round part, or one of many pieces, few groups are near a feature of the track. [m]
struct FeatureGroups {
    FloatRows balls;                     // of each group: x, y, z, radius; padded with balls near nothing
    std::vector<int> counts;             // of each group's features; they begin at kWidestVector x its number
    FloatRows features;                  // as PackedPiece::vertices or edges
    std::vector<std::uint32_t> pieces;   // of each feature
    std::vector<std::uint32_t> indices;  // of each feature in its piece; with kManyEdges, where it has them
};

/// As many as names of features have room for.
inline constexpr int kMostPieces = 1024;

/// contact::ContactBody as the kernel reads it.
struct PackedBody {
    explicit PackedBody(const contact::ContactBody& body);

    std::vector<PackedPiece> pieces;
    FeatureGroups vertices, edges;
    float centre[3];  // of a ball around all features
    float reach;      // its radius
    float radius;     // of a ball around the origin [m]
};

}  // namespace trapwright::native
