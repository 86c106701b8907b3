#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "sim/contact/detector.h"
#include "sim/contact/impulse_solver.h"
#include "sim/contact/pair_detector.h"

namespace trapwright::contact {

/// Added to what a part can travel in a step, so that contacts are there before they carry. [m]
inline constexpr double kTravelMargin = 5e-6;

/// A part at the begin of a step, as others that are near it have to know it.
struct NearPart {
    base::Pose pose;          // part frame to room
    base::Vec3 velocity;      // of the coming step, if nothing touches [m/s]
    base::Vec3 lastVelocity;  // that moved it in the last step [m/s]
    double turn = 0.0;        // how far any point of it may come by turning in the coming step [m]
    double lastTurn = 0.0;    // the same in the last step [m]
};

/// A contact of two parts, A and B: its point and normal in the room's axes.
struct PartContact {
    Contact contact;
    double reach;  // how far the two can come nearer to each other in the step, if nothing touches [m]
};

/// Which parts of one trial are near each other, and where they touch. Each part has a slot as long as it is
/// there, as in TrialContact.
class PartPairs {
 public:
    /// A part comes into a slot that is free.
    void add(int slot, const ContactBody& body);
    void remove(int slot);

    /// Two parts that are near each other.
    struct Pair {
        int a, b;  // a < b
        std::unique_ptr<PairDetector> detector;
    };
    /// Tells anew who is near whom: in the order of a, then of b. positions: of the parts' centres, by slot.
    [[nodiscard]] const std::vector<Pair>& findNear(std::span<const base::Vec3> positions);

    /// All contacts of those that findNear() told, pair by pair. parts: by slot; only those of pairs are
    /// looked at.
    void findContacts(std::span<const NearPart> parts, double dt, std::vector<PartContact>& contacts);

    /// No two parts are near each other.
    void clear() { pairs_.clear(); }

 private:
    std::vector<const ContactBody*> bodies_;  // by slot; null: it is free
    std::vector<Pair> pairs_;
    std::vector<Contact> found_;
};

/// The same contact for ImpulseSolver.
MovingContact describe(const Contact& contact, const base::Pose& a, const base::Pose& b);

}  // namespace trapwright::contact
