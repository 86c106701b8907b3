#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/trial/contact.h"
#include "sim/contact/body_motion.h"
#include "sim/contact/formulas/scalar.h"
#include "sim/contact/law.h"
#include "sim/contact/manifold.h"

namespace trapwright::contact {

/// A part at the begin of a step.
struct MovingBody {
    BodyInertia inertia;
    BodyMotion before;  // in the step before
    BodyMotion free;    // before plus what gravity and gyroscopic torque add in this step
};

/// A contact of one step, in room axes.
struct MovingContact {
    base::Vec3 arm;                  // from B's centre of mass to the point [m]
    base::Vec3 normal;               // unit, A -> B
    double gap;                      // at the step's begin [m]
    base::Vec3 trackVelocity;        // if A is the track: of it at the point, mean over this step [m/s]
    base::Vec3 trackVelocityBefore;  // the same over the step before [m/s]
    std::uint64_t feature;
    trial::Body bodyA = trial::kTrack;
    trial::Body bodyB = 0;
    base::Vec3 armA = base::Vec3::Zero();  // if A is a part: from its centre of mass to the point [m]
};

/// The materials that touch.
struct ContactLaws {
    trial::ContactParameters track;  // parts with the track
    trial::ContactParameters parts;  // parts with each other
};

/// What one contact gave its body B in a step; A has lost as much.
struct ContactImpulse {
    int contact;         // index into the contacts of the step
    base::Vec3 impulse;  // room axes [N s]
};

/// The discrete form of the contact law: impulses at the contacts of parts with the track and with each other
/// over one time step, by projected Gauss-Seidel with warm starting. Velocities are means over a step (they
/// live half-way between two poses), so free flight is exact and a resting part follows the track exactly.
/// Parts that touch each other, directly or by others, are solved together; one that touches none moves as if
/// it were alone, bit for bit. One solver per running trial: it remembers impulses from step to step.
class ImpulseSolver {
 public:
    ImpulseSolver();
    ~ImpulseSolver();
    ImpulseSolver(ImpulseSolver&&) noexcept;
    ImpulseSolver& operator=(ImpulseSolver&&) noexcept;

    /// dt [s]. Contacts of the same two bodies stand one after the other; those of them that say the same are
    /// taken as one, and more than kMaxContacts are thinned out. Slot i of the result is for body i; valid
    /// until the next call.
    std::span<const StepResult> solve(std::span<const MovingBody> bodies,
                                      std::span<const MovingContact> contacts, const ContactLaws& laws,
                                      double dt);

    /// The impulse of each contact of the last solve; for contacts that stand for others, theirs too.
    [[nodiscard]] const std::vector<ContactImpulse>& impulses() const { return impulses_; }

    /// Forgets all impulses: nothing touches any more.
    void release() { remembered_.clear(); }
    /// Forgets the impulses of one body: it is not there any more.
    void forget(trial::Body body) {
        std::erase_if(remembered_,
                      [body](const Remembered& old) { return old.bodyA == body || old.bodyB == body; });
    }
    [[nodiscard]] bool released() const { return remembered_.empty(); }

    static constexpr int kMaxContacts = 12;

    /// What a contact's impulses were in the last step, per mass of B.
    struct Remembered {
        trial::Body bodyA, bodyB;
        std::uint64_t feature;
        double normal;
        scalar::Pair tangential;  // along the constraint's two tangents
        bool sliding;
    };
    /// What the next step begins with: for an engine that solves some parts of a step elsewhere.
    [[nodiscard]] std::vector<Remembered>& memory() { return remembered_; }

 private:
    /// Parts that touch each other, directly or by others, and what they touch.
    struct Island {
        std::vector<int> bodies;
        std::vector<int> contacts;  // in their order
    };
    struct Workspace;

    void findIslands(std::size_t bodies, std::span<const MovingContact> contacts);

    void reduce(std::span<const MovingContact> contacts);
    void solveAlone(std::span<const MovingBody> bodies, std::span<const MovingContact> contacts,
                    std::span<const int> kept, const ContactLaws& laws, double dt);
    void solveTogether(std::span<const MovingBody> bodies, std::span<const MovingContact> contacts,
                       const Island& island, const ContactLaws& laws, double dt);
    void keep(const MovingContact& contact, int index, const scalar::ContactConstraint& row, double mass,
              int moment);
    [[nodiscard]] scalar::MovingContact describe(const MovingContact& contact, int moment);

    std::vector<StepResult> results_;
    std::vector<int> kept_;  // contacts that stand for all
    std::vector<scalar::ContactConstraint> rows_;
    std::vector<ManifoldPoint> points_;
    std::vector<int> islandOf_;  // of each body: the first body on it
    std::vector<Island> islands_;
    std::vector<Remembered> remembered_, next_;
    std::size_t expected_ = 0;  // where remembered_ is likely to have the next contact
    std::vector<ContactImpulse> impulses_;
    std::vector<int> impulseOf_;  // of each contact, its place in impulses_; -1: none
    std::unique_ptr<Workspace> workspace_;
};

}  // namespace trapwright::contact
