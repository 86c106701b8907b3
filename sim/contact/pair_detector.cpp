#include "sim/contact/pair_detector.h"

#include <algorithm>
#include <limits>
#include <span>

namespace trapwright::contact {

using base::Pose;
using base::Vec3;

namespace {

/// How far parts may come nearer before the list of near-by features is made anew. [m]
constexpr double kSkin = 1e-3;
/// Edges that cross deeper than this do not touch: the parts overlap elsewhere. Less than kDeepest, because
/// edges that are nearer than this to each other are looked at in every step. [m]
constexpr double kDeepestEdges = 0.1e-3;
/// A vertex so little beside a face is on it: like parts that stand in line have their corners in common. [m]
constexpr double kBorder = 1e-6;

scalar::Triple toTriple(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

Vec3 fromTriple(const scalar::Triple& v) {
    return {v.x, v.y, v.z};
}

std::uint64_t nameFeature(unsigned kind, int pieceA, int pieceB, int featureA, int featureB) {
    return (std::uint64_t{kind} << 62U) | (static_cast<std::uint64_t>(pieceA) << 51U) |
           (static_cast<std::uint64_t>(pieceB) << 40U) | (static_cast<std::uint64_t>(featureA) << 20U) |
           static_cast<std::uint64_t>(featureB);
}

double beyond(const BodyFace& face, const Vec3& point) {
    return face.normal.dot(point) - face.offset;
}

/// A lower bound of a segment's distance to a piece, or of a point's; in the piece's frame.
double findSeparation(const BodyPiece& piece, const Vec3& from, const Vec3& to) {
    double best = -std::numeric_limits<double>::infinity();
    for (const BodyFace& face : piece.faces)
        best = std::max(best, std::min(beyond(face, from), beyond(face, to)));
    return best;
}

/// A vertex and the face of a piece that holds it.
struct VertexOnFace {
    double gap = 0.0;
    double clear = 0.0;  // they can come nearer by this before they touch
    int face = -1;       // none: no contact
};

/// `vertex`, in the piece's frame, is one of `other`, whose axes `turn` takes to the piece's.
VertexOnFace testVertex(const BodyPiece& piece, const Vec3& vertex, const BodyPiece& other,
                        const BodyVertex& own, const base::Mat3& turn, double margin) {
    VertexOnFace result;
    int nearest = 0;
    double outside = -std::numeric_limits<double>::infinity();
    for (int f = 0; f < static_cast<int>(piece.faces.size()); ++f) {
        const double d = beyond(piece.faces[static_cast<std::size_t>(f)], vertex);
        if (d <= outside) continue;
        outside = d;
        nearest = f;
        if (outside >= margin) break;  // far enough
    }
    result.clear = std::max(outside, -outside - kDeepest);
    if (outside >= margin || outside <= -kDeepest) return result;

    // The vertex's part must lie above the face: otherwise it passes beside it.
    const auto holds = [&](int f) {
        const Vec3& normal = piece.faces[static_cast<std::size_t>(f)].normal;
        const std::span edges(other.vertexEdges.data() + own.firstEdge,
                              static_cast<std::size_t>(own.edgeCount));
        return std::ranges::all_of(edges, [&](const Vec3& edge) {
            const Vec3 turned = turn * edge;
            return normal.dot(turned) >= -scalar::kConeSlack;
        });
    };
    if (holds(nearest)) {
        result.face = nearest;
        result.gap = outside;
        return result;
    }
    if (outside > kBorder) return result;
    // At the border of faces, or in it by less than it is in any other: the best that holds it.
    double best = -kDeepest;
    for (int f = 0; f < static_cast<int>(piece.faces.size()); ++f) {
        const double d = beyond(piece.faces[static_cast<std::size_t>(f)], vertex);
        if (d <= best || !holds(f)) continue;
        best = d;
        result.face = f;
        result.gap = d;
    }
    return result;
}

scalar::Edge toEdge(const BodyEdge& edge) {
    return {toTriple(edge.from),
            toTriple(edge.direction),
            edge.length,
            {toTriple(edge.into[0]), toTriple(edge.into[1])}};
}

/// The same, in A's frame.
BodyEdge moveEdge(const BodyEdge& edge, const Pose& bInA, const base::Mat3& turn) {
    return {bInA.apply(edge.from),
            bInA.apply(edge.to),
            turn * edge.direction,
            edge.length,
            {turn * edge.into[0], turn * edge.into[1]}};
}

/// The distance of an edge of A and one of B, in A's frame.
double distance(const BodyEdge& a, const BodyEdge& b, const Pose& bInA, const base::Mat3& turn) {
    const Vec3 direction = turn * b.direction;
    const scalar::Triple between =
        scalar::findBetween({toTriple(a.from), toTriple(a.direction), a.length},
                            {toTriple(bInA.apply(b.from)), toTriple(direction), b.length});
    return fromTriple(between).norm();
}

}  // namespace

void PairDetector::findContacts(const Pose& poseA, const Pose& poseB, double moved, double margin,
                                std::vector<Contact>& contacts) {
    travel_ += moved;
    if (travel_ + margin < nextLook_) return;
    const Pose aToCommon{poseA.rotation.conjugate(), poseA.rotation.conjugate() * -poseA.position};
    const Pose bInA{aToCommon.rotation * poseB.rotation, aToCommon.apply(poseB.position)};
    if (travel_ + margin >= collectAt_) collectCandidates(bInA, margin);

    const base::Mat3 turn = bInA.rotation.toRotationMatrix();
    const base::Mat3 turnBack = turn.transpose();
    nextLook_ = collectAt_;
    for (Candidate& candidate : candidates_) {
        if (travel_ + margin < candidate.clearUntil) {
            nextLook_ = std::min(nextLook_, candidate.clearUntil);
            continue;
        }
        const BodyPiece& pieceA = a_->pieces[static_cast<std::size_t>(candidate.pieceA)];
        const BodyPiece& pieceB = b_->pieces[static_cast<std::size_t>(candidate.pieceB)];
        const auto featureA = static_cast<std::size_t>(candidate.featureA);
        const auto featureB = static_cast<std::size_t>(candidate.featureB);
        const auto name = [&](unsigned kind, int ofA, int ofB) {
            return nameFeature(kind, candidate.pieceA, candidate.pieceB, ofA, ofB);
        };
        double clear = 0.0;
        switch (candidate.kind) {
            case Kind::vertexOfB: {
                const BodyVertex& vertex = pieceB.vertices[featureB];
                const Vec3 point = bInA.apply(vertex.position);
                const VertexOnFace found = testVertex(pieceA, point, pieceB, vertex, turn, margin);
                clear = found.clear;
                if (found.face >= 0)
                    contacts.push_back({point, pieceA.faces[static_cast<std::size_t>(found.face)].normal,
                                        found.gap, name(0, found.face, candidate.featureB)});
                break;
            }
            case Kind::vertexOfA: {
                const BodyVertex& vertex = pieceA.vertices[featureA];
                const Vec3 point = turnBack * (vertex.position - bInA.position);
                const VertexOnFace found = testVertex(pieceB, point, pieceA, vertex, turnBack, margin);
                clear = found.clear;
                if (found.face >= 0)
                    contacts.push_back({vertex.position,
                                        turn * -pieceB.faces[static_cast<std::size_t>(found.face)].normal,
                                        found.gap, name(2, candidate.featureA, found.face)});
                break;
            }
            case Kind::edges: {
                const BodyEdge& ofA = pieceA.edges[featureA];
                clear = distance(ofA, pieceB.edges[featureB], bInA, turn) - kDeepestEdges;
                if (clear + kDeepestEdges >= std::max(margin, kDeepestEdges)) break;
                const BodyEdge ofB = moveEdge(pieceB.edges[featureB], bInA, turn);
                const Vec3 outward = -(ofA.into[0] + ofA.into[1]);
                const scalar::EdgeTest test =
                    scalar::testEdges(toEdge(ofB), toEdge(ofA), toTriple(outward), margin);
                if (!test.touching || test.gap <= -kDeepestEdges) break;
                contacts.push_back({ofB.from + test.alongPart * ofB.direction, fromTriple(test.normal),
                                    test.gap, name(1, candidate.featureA, candidate.featureB)});
                break;
            }
        }
        candidate.clearUntil = travel_ + clear;
        nextLook_ = std::min(nextLook_, candidate.clearUntil);
    }
}

void PairDetector::collectCandidates(const Pose& bInA, double margin) {
    candidates_.clear();
    const double reach = kSkin + margin;
    const double apart = bInA.position.norm() - a_->radius - b_->radius;
    if (apart > reach) {
        collectAt_ = travel_ + apart;
        return;
    }
    collectAt_ = travel_ + reach;
    const base::Mat3 turn = bInA.rotation.toRotationMatrix();
    const auto toB = [&](const Vec3& p) -> Vec3 { return turn.transpose() * (p - bInA.position); };
    for (int p = 0; p < static_cast<int>(a_->pieces.size()); ++p) {
        const BodyPiece& pieceA = a_->pieces[static_cast<std::size_t>(p)];
        for (int q = 0; q < static_cast<int>(b_->pieces.size()); ++q) {
            const BodyPiece& pieceB = b_->pieces[static_cast<std::size_t>(q)];
            const double balls =
                (bInA.apply(pieceB.centre) - pieceA.centre).norm() - pieceA.radius - pieceB.radius;
            if (balls >= reach) continue;
            for (int v = 0; v < static_cast<int>(pieceB.vertices.size()); ++v) {
                const Vec3 point = bInA.apply(pieceB.vertices[static_cast<std::size_t>(v)].position);
                if (findSeparation(pieceA, point, point) < reach)
                    candidates_.push_back({Kind::vertexOfB, p, q, 0, v, -1.0});
            }
            std::vector<int> near;
            for (int e = 0; e < static_cast<int>(pieceB.edges.size()); ++e) {
                const BodyEdge& edge = pieceB.edges[static_cast<std::size_t>(e)];
                if (findSeparation(pieceA, bInA.apply(edge.from), bInA.apply(edge.to)) < reach)
                    near.push_back(e);
            }
            for (int e = 0; e < static_cast<int>(pieceA.edges.size()) && !near.empty(); ++e) {
                const BodyEdge& edge = pieceA.edges[static_cast<std::size_t>(e)];
                if (findSeparation(pieceB, toB(edge.from), toB(edge.to)) >= reach) continue;
                for (const int other : near) {
                    const BodyEdge& ofB = pieceB.edges[static_cast<std::size_t>(other)];
                    if (distance(edge, ofB, bInA, turn) < reach)
                        candidates_.push_back({Kind::edges, p, q, e, other, -1.0});
                }
            }
            for (int v = 0; v < static_cast<int>(pieceA.vertices.size()); ++v) {
                const Vec3 point = toB(pieceA.vertices[static_cast<std::size_t>(v)].position);
                if (findSeparation(pieceB, point, point) < reach)
                    candidates_.push_back({Kind::vertexOfA, p, q, v, 0, -1.0});
            }
        }
    }
}

}  // namespace trapwright::contact
