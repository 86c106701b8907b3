#include "sim/contact/detector.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace trapwright::contact {

using base::Mat3;
using base::Vec3;

namespace {

/// How far a part may travel before the list of near-by features is made anew. [m]
constexpr double kSkin = 4e-3;

scalar::Triple toTriple(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

scalar::Plane toPlane(const BodyFace& face) {
    return {toTriple(face.normal), -face.offset - (face.isCut ? kCutSlack : 0.0)};
}

std::uint64_t nameFeature(unsigned kind, int piece, int bodyFeature, int trackFeature) {
    return (std::uint64_t{kind} << 62U) | (static_cast<std::uint64_t>(piece) << 48U) |
           (static_cast<std::uint64_t>(bodyFeature) << 28U) | static_cast<std::uint64_t>(trackFeature);
}

double distanceToSegment(const Vec3& point, const Vec3& from, const Vec3& direction, double length) {
    const double along = std::clamp(direction.dot(point - from), 0.0, length);
    return (from + along * direction - point).norm();
}

/// Distances of segment a-b from the planes of a piece's faces.
struct Separation {
    double largest = -1e300;  // a lower bound of the distance of the segment to the piece [m]
    double second = -1e300;   // of the other faces [m]
    int secondFace = -1;
};

/// By min(face distance of a, face distance of b). Cuts count only where it is beyond them. Stops at the
/// first that reaches `enough`; `face` is tried first and told.
Separation findSeparation(const BodyPiece& piece, const Vec3& a, const Vec3& b, double enough, int& face) {
    const auto distance = [&, from = toTriple(a), to = toTriple(b)](int f) {
        const double d = scalar::calcSeparation(toPlane(piece.faces[f]), from, to);
        return piece.faces[f].isCut && d <= 0.0 ? -1e300 : d;
    };
    const int first = face;
    Separation best;
    best.largest = distance(face);
    if (best.largest >= enough) return best;
    for (int f = 0; f < static_cast<int>(piece.faces.size()); ++f) {
        if (f == first) continue;
        const double d = distance(f);
        if (d > best.largest) {
            best.second = std::exchange(best.largest, d);
            best.secondFace = std::exchange(face, f);
            if (best.largest >= enough) return best;
        } else if (d > best.second) {
            best.second = d;
            best.secondFace = f;
        }
    }
    return best;
}

}  // namespace

struct Detector::Query {
    Mat3 toTrack;   // rotation part -> track
    Vec3 position;  // of the part's origin in the track frame
    Vec3 shift;     // in the part frame, as ...
    Vec3 turn;      // ... this
    double margin;
    std::vector<Contact>* contacts;

    [[nodiscard]] Vec3 pointToPart(const Vec3& p) const { return toTrack.transpose() * (p - position); }
    [[nodiscard]] Vec3 pointToTrack(const Vec3& p) const { return toTrack * p + position; }
    [[nodiscard]] Vec3 vectorToPart(const Vec3& v) const { return toTrack.transpose() * v; }
};

void Detector::findContacts(const base::Pose& partInTrack, const ComingWay& coming, double moved,
                            double margin, std::vector<Contact>& contacts) {
    contacts.clear();
    travel_ += moved;
    if (travel_ + margin < nextLook_) return;
    if (travel_ + margin >= collectAt_) collectCandidates(partInTrack, margin);

    const Mat3 toTrack = partInTrack.rotation.toRotationMatrix();
    const Query query{toTrack,
                      partInTrack.position,
                      toTrack.transpose() * coming.shift,
                      toTrack.transpose() * coming.turn,
                      margin,
                      &contacts};
    nextLook_ = collectAt_;
    for (Candidate& candidate : candidates_) {
        if (travel_ + margin >= candidate.clearUntil) {
            double clear = 0.0;
            switch (candidate.kind) {
                case Kind::vertexOnTriangle:
                    clear = testTriangle(query, candidate);
                    break;
                case Kind::edgeAcrossEdge:
                    clear = testEdge(query, candidate);
                    break;
                case Kind::faceOnVertex:
                    clear = testVertex(query, candidate);
                    break;
            }
            candidate.clearUntil = travel_ + clear;
        }
        nextLook_ = std::min(nextLook_, candidate.clearUntil);
    }
}

void Detector::collectCandidates(const base::Pose& partInTrack, double margin) {
    candidates_.clear();
    const double reach = kSkin + margin;
    for (int p = 0; p < static_cast<int>(body_->pieces.size()); ++p) {
        const BodyPiece& piece = body_->pieces[p];
        const Vec3 centre = partInTrack.apply(piece.centre);
        const double radius = piece.radius + reach;
        const auto near = [&](const Vec3& other, double otherRadius) {
            const double far = radius + otherRadius;
            return (other - centre).squaredNorm() < far * far;
        };
        for (int i = 0; i < static_cast<int>(track_->triangles.size()); ++i) {
            const TrackTriangle& t = track_->triangles[i];
            if (!piece.vertices.empty() && near(t.centre, t.radius))
                candidates_.push_back({Kind::vertexOnTriangle, p, i, 0, -1.0});
        }
        for (int i = 0; i < static_cast<int>(track_->edges.size()); ++i) {
            const TrackEdge& e = track_->edges[i];
            if (!piece.edges.empty() && near(e.centre, e.radius))
                candidates_.push_back({Kind::edgeAcrossEdge, p, i, 0, -1.0});
        }
        for (int i = 0; i < static_cast<int>(track_->vertices.size()); ++i) {
            if (near(track_->vertices[i].position, 0.0))
                candidates_.push_back({Kind::faceOnVertex, p, i, 0, -1.0});
        }
    }
    collectAt_ = travel_ + reach;
}

double Detector::testTriangle(const Query& query, const Candidate& candidate) const {
    const TrackTriangle& triangle = track_->triangles[candidate.feature];
    const BodyPiece& piece = body_->pieces[candidate.piece];

    // The piece's ball against the plane and against the triangle's sides.
    const Vec3 centre = query.pointToTrack(piece.centre);
    const double height = triangle.normal.dot(centre - triangle.corner);
    double clear = std::max(height, -height - kDeepest) - piece.radius;
    for (int c = 0; c < 3; ++c)
        clear = std::max(clear, triangle.edgeNormal[c].dot(centre) - triangle.edgeOffset[c] - piece.radius);
    if (clear >= query.margin) return clear;

    const auto toPart = [&](const Vec3& planeNormal, double offset) {
        return scalar::Plane{toTriple(query.vectorToPart(planeNormal)),
                             planeNormal.dot(query.position) - offset};
    };
    const scalar::Plane plane = toPart(triangle.normal, triangle.normal.dot(triangle.corner));
    const scalar::Plane sides[3] = {toPart(triangle.edgeNormal[0], triangle.edgeOffset[0]),
                                    toPart(triangle.edgeNormal[1], triangle.edgeOffset[1]),
                                    toPart(triangle.edgeNormal[2], triangle.edgeOffset[2])};
    double nearest = 1e300;
    for (int v = 0; v < static_cast<int>(piece.vertices.size()); ++v) {
        const BodyVertex& vertex = piece.vertices[v];
        const scalar::VertexTest test = scalar::testVertex(toTriple(vertex.position), plane, sides);
        nearest = std::min(nearest, test.clear);
        if (test.clear >= query.margin) continue;
        const scalar::Triple way = toTriple(query.shift + query.turn.cross(vertex.position));
        // The part must lie above the plane: otherwise the vertex passes by (along the border of the face
        // that the part lies on) or touches the other flank of a thin wall.
        bool above = scalar::meetsTriangle(test, way, plane, sides, triangle.ridges);
        for (int e = 0; e < vertex.edgeCount && above; ++e)
            above =
                dot(plane.normal, toTriple(piece.vertexEdges[vertex.firstEdge + e])) >= -scalar::kConeSlack;
        if (!above) continue;
        query.contacts->push_back({query.pointToTrack(vertex.position), triangle.normal, test.gap,
                                   nameFeature(0, candidate.piece, v, candidate.feature)});
    }
    return std::max(nearest, clear);
}

double Detector::testEdge(const Query& query, Candidate& candidate) const {
    const TrackEdge& edge = track_->edges[candidate.feature];
    const BodyPiece& piece = body_->pieces[candidate.piece];
    const double length = 2.0 * edge.radius;

    const Vec3 from = query.pointToPart(edge.from);
    const Vec3 direction = query.vectorToPart(edge.direction);
    const double ball = distanceToSegment(piece.centre, from, direction, length) - piece.radius;
    if (ball >= query.margin) return ball;
    const double apart =
        findSeparation(piece, from, from + length * direction, query.margin, candidate.separatingFace)
            .largest;
    if (apart >= query.margin) return apart;

    const scalar::Triple outward = toTriple(query.vectorToPart(edge.outward));
    const scalar::Edge track{
        toTriple(from),
        toTriple(direction),
        length,
        {toTriple(query.vectorToPart(edge.into[0])), toTriple(query.vectorToPart(edge.into[1]))}};
    for (int e = 0; e < static_cast<int>(piece.edges.size()); ++e) {
        const BodyEdge& own = piece.edges[e];
        const scalar::EdgeTest test = scalar::testEdges({toTriple(own.from),
                                                         toTriple(own.direction),
                                                         own.length,
                                                         {toTriple(own.into[0]), toTriple(own.into[1])}},
                                                        track, outward, query.margin);
        if (!test.touching) continue;
        query.contacts->push_back({query.pointToTrack(own.from + test.alongPart * own.direction),
                                   query.toTrack * Vec3(test.normal.x, test.normal.y, test.normal.z),
                                   test.gap, nameFeature(1, candidate.piece, e, candidate.feature)});
    }
    return std::max(apart, ball);
}

double Detector::testVertex(const Query& query, Candidate& candidate) const {
    const TrackVertex& vertex = track_->vertices[candidate.feature];
    const BodyPiece& piece = body_->pieces[candidate.piece];
    const Vec3 point = query.pointToPart(vertex.position);
    const Separation separation = findSeparation(piece, point, point, query.margin, candidate.separatingFace);
    const double gap = separation.largest;
    if (gap >= query.margin || gap <= -kDeepest) return std::max(gap, -gap - kDeepest);

    if (separation.second > -scalar::kBorder) return gap;
    const auto edges =
        std::span(track_->vertexEdges).subspan(vertex.firstEdge, static_cast<std::size_t>(vertex.edgeCount));
    const auto leads = [](const Vec3& edge, const Vec3& way) { return edge.dot(way) > scalar::kConeSlack; };
    const auto normalOf = [&](int face) -> Vec3 { return query.toTrack * -piece.faces[face].normal; };
    const auto add = [&](int face, const Vec3& normal, double depth) {
        query.contacts->push_back(
            {vertex.position, normal, depth, nameFeature(2, candidate.piece, face, candidate.feature)});
    };
    // The track must lie below the face: a part that slides level over a border is not stopped by it.
    const Vec3 first = normalOf(candidate.separatingFace);
    if (std::ranges::none_of(edges, [&](const Vec3& edge) { return leads(edge, first); })) {
        add(candidate.separatingFace, first, gap);
        return gap;
    }
    if (gap > 0.0 || separation.second <= -kDeepest) return gap;
    // Near to a border of the face that it lies below a vertex is less deep from beside. What of the track
    // rises beyond that border is beside the part, not above the face.
    const Vec3 second = normalOf(separation.secondFace);
    const auto carries = [&](const Vec3& normal, const Vec3& beside) {
        return std::ranges::none_of(
            edges, [&](const Vec3& edge) { return leads(edge, normal) && !leads(edge, -beside); });
    };
    if (carries(second, first))
        add(separation.secondFace, second, separation.second);
    else if (gap <= -scalar::kBorder && carries(first, second))
        add(candidate.separatingFace, first, gap);
    return gap;
}

}  // namespace trapwright::contact
