#include "sim/contact/contact_body.h"

#include <algorithm>

#include "sim/contact/formulas/scalar.h"
#include "sim/contact/union_features.h"

namespace trapwright::contact {

using base::Vec3;

namespace {

/// How far a point is beyond the face that it is farthest beyond; negative inside. [m]
double calcHeight(const geometry::ConvexPolytope& polytope, const Vec3& point) {
    double height = -1e300;
    for (const geometry::PolytopeFace& face : polytope.faces)
        height = std::max(height, face.normal.dot(point) - face.offset);
    return height;
}

/// Whether the other pieces lie against all of a face, as far as points all over it tell.
bool isCovered(const std::vector<geometry::ConvexPolytope>& pieces, std::size_t piece,
               const geometry::PolytopeFace& face, double touching) {
    const std::vector<Vec3>& vertices = pieces[piece].vertices;
    Vec3 centre = Vec3::Zero();
    for (const int v : face.loop)
        centre += vertices[v] / static_cast<double>(face.loop.size());
    const auto isMet = [&](const Vec3& point) {
        const Vec3 beyond = point + touching * face.normal;
        for (std::size_t q = 0; q < pieces.size(); ++q)
            if (q != piece && calcHeight(pieces[q], beyond) <= touching) return true;
        return false;
    };
    if (!isMet(centre)) return false;
    for (std::size_t i = 0; i < face.loop.size(); ++i) {
        const Vec3& from = vertices[face.loop[i]];
        const Vec3& to = vertices[face.loop[(i + 1) % face.loop.size()]];
        for (const double out : {0.5, 0.95})
            for (const Vec3& border : {from, Vec3(0.5 * (from + to))})
                if (!isMet(centre + out * (border - centre))) return false;
    }
    return true;
}

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

/// An edge goes on from another's end if it bends away by less than this. (cosine)
constexpr double kBend = 0.2;

/// Takes the ends off edges (scalar::kBorder) from which no other one goes on.
void shortenEdges(std::vector<BodyPiece>& pieces, double touching) {
    struct End {
        Vec3 place, into;
    };
    std::vector<End> whole;
    for (const BodyPiece& piece : pieces)
        for (const BodyEdge& edge : piece.edges) {
            whole.push_back({edge.from, edge.direction});
            whole.push_back({edge.to, -edge.direction});
        }
    const auto goesOn = [&](const Vec3& end, const Vec3& away) {
        return std::ranges::any_of(whole, [&](const End& other) {
            return (other.place - end).norm() <= touching && other.into.dot(away) > kBend;
        });
    };
    for (BodyPiece& piece : pieces)
        for (BodyEdge& edge : piece.edges) {
            const bool begins = !goesOn(edge.from, -edge.direction);
            const bool ends = !goesOn(edge.to, edge.direction);
            if (begins) edge.from += scalar::kBorder * edge.direction;
            if (ends) edge.to -= scalar::kBorder * edge.direction;
            edge.length = (edge.to - edge.from).norm();
        }
}

}  // namespace

ContactBody prepareBody(const std::vector<geometry::ConvexPolytope>& pieces) {
    ContactBody body;
    for (const geometry::ConvexPolytope& polytope : pieces) {
        body.pieces.push_back(preparePiece(polytope));
        for (const Vec3& vertex : polytope.vertices)
            body.radius = std::max(body.radius, vertex.norm());
    }
    const double touching = kTouching * body.radius;
    if (body.pieces.size() > 1) {
        keepUnionFeatures(body.pieces, touching);
        for (std::size_t p = 0; p < pieces.size(); ++p)
            for (std::size_t f = 0; f < pieces[p].faces.size(); ++f)
                body.pieces[p].faces[f].isCut = isCovered(pieces, p, pieces[p].faces[f], touching);
    }
    shortenEdges(body.pieces, touching);
    return body;
}

}  // namespace trapwright::contact
