#include "sim/native/packed_body.h"

namespace trapwright::native {

using base::Vec3;

namespace {

void set(FloatRows& rows, int firstRow, int column, const Vec3& value) {
    for (int k = 0; k < 3; ++k)
        rows.row(firstRow + k)[column] = static_cast<float>(value[k]);
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
    packed.faces = FloatRows(4, faceCount);
    for (int f = 0; f < packed.faces.stride(); ++f) {
        const contact::BodyFace& face = piece.faces[f < faceCount ? f : 0];
        set(packed.faces, 0, f, face.normal);
        packed.faces.row(3)[f] = f < faceCount ? static_cast<float>(-face.offset) : -1e6F;
    }
    return packed;
}

}  // namespace

PackedBody::PackedBody(const contact::ContactBody& body) : radius(static_cast<float>(body.radius)) {
    for (const contact::BodyPiece& piece : body.pieces)
        pieces.push_back(pack(piece));
}

}  // namespace trapwright::native
