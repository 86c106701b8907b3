#pragma once

#include <cstdint>
#include <vector>

#include "core/base/math.h"
#include "sim/contact/contact_body.h"
#include "sim/contact/detector.h"

namespace trapwright::contact {

/// Finds the contacts of one part, B, with another, A, step after step. Three kinds of feature pairs: vertex
/// of B on face of A, vertex of A on face of B, edge across edge. Normals are told by the features alone
/// (their cones), as with the track; a pair of features that is far apart is not looked at again before they
/// can have come near.
class PairDetector {
 public:
    PairDetector(const ContactBody& a, const ContactBody& b) : a_(&a), b_(&b) {}

    /// Adds all pairs with a gap below `margin`, points and normals in A's part frame; the bodies are left to
    /// whoever knows their numbers. `moved` bounds how far any two points of the parts have come nearer to
    /// each other since the last call. Poses: part frames to any common one. [m]
    void findContacts(const base::Pose& poseA, const base::Pose& poseB, double moved, double margin,
                      std::vector<Contact>& contacts);

 private:
    enum class Kind : std::uint8_t { vertexOfB, edges, vertexOfA };
    struct Candidate {
        Kind kind;
        int pieceA, pieceB;
        int featureA, featureB;  // vertices, edges; of a vertex's partner: nothing
        double clearUntil;       // travel_ + margin below this: no contact possible
    };

    void collectCandidates(const base::Pose& bInA, double margin);

    const ContactBody* a_;
    const ContactBody* b_;
    std::vector<Candidate> candidates_;
    double travel_ = 0.0;      // sum of `moved` [m]
    double collectAt_ = -1.0;  // travel_ + margin at which the candidates must be collected anew
    double nextLook_ = -1.0;   // travel_ + margin at which the first candidate must be looked at
};

}  // namespace trapwright::contact
