#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/math.h"
#include "sim/contact/formulas/scalar.h"
#include "sim/contact/law.h"
#include "sim/contact/manifold_point.h"

namespace trapwright::contact {

/// Velocity of the centre of mass and angular velocity, or the impulses that change them. Room axes.
struct BodyMotion {
    base::Vec3 velocity = base::Vec3::Zero();         // [m/s]
    base::Vec3 angularVelocity = base::Vec3::Zero();  // [rad/s]

    [[nodiscard]] base::Vec3 at(const base::Vec3& arm) const { return velocity + angularVelocity.cross(arm); }
};

/// The part's inverse inertia in room axes.
struct BodyInertia {
    double inverseMass;         // [1/kg]
    base::Mat3 inverseInertia;  // about the centre of mass [1/(kg m^2)]
};

/// A contact of one step, in room axes.
struct MovingContact {
    base::Vec3 arm;                  // from the centre of mass to the point [m]
    base::Vec3 normal;               // unit, track -> part
    double gap;                      // at the step's begin [m]
    base::Vec3 trackVelocity;        // of the track at the point, mean over this step [m/s]
    base::Vec3 trackVelocityBefore;  // the same over the step before [m/s]
    std::uint64_t feature;
};

/// What one contact gave the part in a step.
struct ContactImpulse {
    int contact;         // index into the contacts of the step
    base::Vec3 impulse;  // room axes [N s]
};

/// What a step does to a part.
struct StepResult {
    BodyMotion motion;   // after the step's impulses
    BodyMotion advance;  // moves the pose over the step: an impact happens inside it
    int carrying = 0;    // contacts with an impulse
};

/// The discrete form of the contact law: impulses of one part's contacts over one time step, by projected
/// Gauss-Seidel with warm starting. Velocities are means over a step (they live half-way between two poses),
/// so free flight is exact and a resting part follows the track exactly. One solver per running trial: it
/// remembers impulses from step to step.
class ImpulseSolver {
 public:
    /// before: motion in the step before. free: before plus what gravity and gyroscopic torque add in this
    /// step. dt [s]. Contacts that say the same are taken as one, more than
    /// kMaxContacts are thinned out.
    StepResult solve(const BodyInertia& inertia, const BodyMotion& before, const BodyMotion& free,
                     const std::vector<MovingContact>& contacts, const trial::ContactParameters& law,
                     double dt);

    /// The impulse that each contact of the last solve gave a part of this mass [kg]; for contacts that stand
    /// for others, theirs too.
    [[nodiscard]] std::vector<ContactImpulse> impulses(double mass) const;

    /// Forgets all impulses: the part no longer touches anything.
    void release() { remembered_.clear(); }
    [[nodiscard]] bool released() const { return remembered_.empty(); }

    static constexpr int kMaxContacts = 12;

 private:
    struct Remembered {
        std::uint64_t feature;
        double normal;
        scalar::Pair tangential;  // along the row's two tangents
        bool sliding;
    };

    [[nodiscard]] scalar::MovingContact describe(const MovingContact& contact) const;

    std::vector<scalar::ContactConstraint> rows_;
    std::array<int, kMaxContacts> kept_{};  // which contact each row is of
    std::vector<ManifoldPoint> points_;
    std::vector<Remembered> remembered_;
};

}  // namespace trapwright::contact
