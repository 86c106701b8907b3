#pragma once

#include <memory>

#include "core/base/math.h"
#include "sim/contact/body_motion.h"

namespace trapwright::simbody {

/// A number of like, free, non-interacting bodies in one SimTK::MultibodySystem under Simbody's gravity: the
/// cheapest way to step many parts. Simbody owns state, kinematics, mass properties and gravity; the stepping
/// is semi-explicit with velocities at the middles of steps. Slots are independent of each other to the last
/// bit.
class FreeBodies {
 public:
    /// inertia: about the centre of mass, in body axes [kg m^2]; gravity in the room [m/s^2].
    FreeBodies(double mass, const base::Mat3& inertia, const base::Vec3& gravity, int count);
    ~FreeBodies();
    FreeBodies(FreeBodies&&) noexcept;
    FreeBodies& operator=(FreeBodies&&) noexcept;

    [[nodiscard]] int count() const;
    [[nodiscard]] double inverseMass() const;
    [[nodiscard]] const base::Mat3& inverseInertia() const;

    /// Puts a body somewhere at time 0 with the velocities that it has at that moment.
    void place(int slot, const base::Pose& pose, const contact::BodyMotion& motion, double dt);
    /// Takes body `slot` of `other` over, bit for bit.
    void adopt(int slot, const FreeBodies& other, int otherSlot);

    /// Tells what gravity and gyroscopic torque do to all bodies in the coming step.
    void beginStep(double dt);
    [[nodiscard]] base::Pose pose(int slot) const;             // at the step's begin, or after endStep
    [[nodiscard]] contact::BodyMotion before(int slot) const;  // motion of the step before
    [[nodiscard]] contact::BodyMotion free(int slot) const;    // before + unconstrained acceleration * dt
    [[nodiscard]] contact::BodyMotion now(int slot, double dt) const;  // at the pose's time, third order
    /// Says what the contacts made of it; in every step, with free() where nothing touches.
    void resolve(int slot, const contact::StepResult& result);
    /// Moves all bodies to the step's end.
    void endStep(double dt);

 private:
    struct Model;
    std::unique_ptr<Model> model_;
};

}  // namespace trapwright::simbody
