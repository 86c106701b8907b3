#pragma once

#include <cstdint>
#include <vector>

#include "core/base/math.h"
#include "core/trial/contact.h"
#include "sim/contact/contact_body.h"
#include "sim/contact/contact_track.h"
#include "sim/contact/formulas/scalar.h"

namespace trapwright::contact {

/// A place where two bodies touch or are about to.
struct Contact {
    base::Vec3 point;       // track frame [m]
    base::Vec3 normal;      // unit, out of A into B
    double gap;             // along the normal; negative: overlap [m]
    std::uint64_t feature;  // names the pair of features, to recognise it in the next step
    trial::Body bodyA = trial::kTrack;
    trial::Body bodyB = 0;
};

/// How a part is about to move if nothing touches it, relative to the track and in its axes.
struct ComingWay {
    base::Vec3 shift = base::Vec3::Zero();  // of its origin [m]
    base::Vec3 turn = base::Vec3::Zero();   // [rad]
};

/// Finds the contacts of one part with one track, step after step. Three kinds of feature pairs: part vertex
/// on track triangle, part edge across strictly convex track edge, track vertex on part face. A pair that is
/// far away is not looked at again before the part can have come near. One detector per running trial.
class Detector {
 public:
    Detector(const ContactTrack& track, const ContactBody& body) : track_(&track), body_(&body) {}

    /// All pairs with a gap below `margin`. `moved` bounds how far any point of the part has moved relative
    /// to the track since the last call. [m] `coming`: what vertices slide past on this way is left out.
    void findContacts(const base::Pose& partInTrack, const ComingWay& coming, double moved, double margin,
                      std::vector<Contact>& contacts);

 private:
    enum class Kind : std::uint8_t { vertexOnTriangle, edgeAcrossEdge, faceOnVertex };
    struct Candidate {
        Kind kind;
        int piece;
        int feature;         // of the track
        int separatingFace;  // of the piece, where last found
        double clearUntil;   // travel_ + margin below this: no contact possible
    };
    struct Query;  // what one call needs to know

    void collectCandidates(const base::Pose& partInTrack, double margin);
    [[nodiscard]] double testTriangle(const Query& query, const Candidate& candidate) const;
    [[nodiscard]] double testEdge(const Query& query, Candidate& candidate) const;
    [[nodiscard]] double testVertex(const Query& query, Candidate& candidate) const;

    const ContactTrack* track_;
    const ContactBody* body_;
    std::vector<Candidate> candidates_;
    double travel_ = 0.0;      // sum of `moved` [m]
    double collectAt_ = -1.0;  // travel_ + margin at which the candidates must be collected anew
    double nextLook_ = -1.0;   // travel_ + margin at which the first candidate must be looked at
};

/// Overlaps deeper than this are not contacts: the part is elsewhere. [m]
using scalar::kDeepest;

}  // namespace trapwright::contact
