#include "sim/contact/contact_body.h"

#include <algorithm>

#include "sim/contact/union_features.h"

namespace trapwright::contact {

using base::Vec3;

namespace {

/// Pieces that are nearer to each other touch: several times what their cuts are off a plane. Relative to the
/// body's radius.
constexpr double kTouching = 2e-5;

BodyPiece preparePiece(const geometry::ConvexPolytope& polytope) {
    BodyPiece piece;
    std::vector<std::vector<Vec3>> directions(polytope.vertices.size());
    for (const geometry::PolytopeEdge& edge : polytope.edges) {
        const Vec3& from = polytope.vertices[edge.from];
        const Vec3& to = polytope.vertices[edge.to];
        const Vec3 direction = (to - from).normalized();
        directions[edge.from].push_back(direction);
        directions[edge.to].push_back(-direction);
        // Seen from outside the left face lies to the left of from -> to.
        const Vec3 intoLeft = polytope.faces[edge.left].normal.cross(direction);
        const Vec3 intoRight = direction.cross(polytope.faces[edge.right].normal);
        piece.edges.push_back({from, to, direction, (to - from).norm(), {intoLeft, intoRight}});
    }
    piece.centre = Vec3::Zero();
    for (const Vec3& vertex : polytope.vertices)
        piece.centre += vertex / static_cast<double>(polytope.vertices.size());
    piece.radius = 0.0;
    for (std::size_t v = 0; v < polytope.vertices.size(); ++v) {
        piece.vertices.push_back({polytope.vertices[v], static_cast<int>(piece.vertexEdges.size()),
                                  static_cast<int>(directions[v].size())});
        piece.vertexEdges.insert(piece.vertexEdges.end(), directions[v].begin(), directions[v].end());
        piece.radius = std::max(piece.radius, (polytope.vertices[v] - piece.centre).norm());
    }
    for (const geometry::PolytopeFace& face : polytope.faces)
        piece.faces.push_back({face.normal, face.offset});
    return piece;
}

}  // namespace

ContactBody prepareBody(const std::vector<geometry::ConvexPolytope>& pieces) {
    ContactBody body;
    for (const geometry::ConvexPolytope& polytope : pieces) {
        body.pieces.push_back(preparePiece(polytope));
        for (const Vec3& vertex : polytope.vertices)
            body.radius = std::max(body.radius, vertex.norm());
    }
    if (body.pieces.size() > 1) keepUnionFeatures(body.pieces, kTouching * body.radius);
    return body;
}

}  // namespace trapwright::contact
