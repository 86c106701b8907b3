#pragma once

#include "core/trial/batch.h"
#include "sim/contact/drive_motion.h"
#include "sim/contact/impulse_solver.h"

namespace trapwright::peers {

/// Force at the centre of mass and torque. Axes of the frame.
struct Wrench {
    base::Vec3 force;   // [N]
    base::Vec3 torque;  // [N m]
};

/// The frame of a vibrating track, for simulators whose track must stand still: what a part feels in it.
class VibratingFrame {
 public:
    VibratingFrame(const trial::TrialBatch& batch, std::size_t trial, double dt);

    [[nodiscard]] const contact::TrackPlacement& placement() const { return now_; }
    /// Motion in the frame of a part that has `motion` in the room, `position` in the frame; and the other
    /// way.
    [[nodiscard]] contact::BodyMotion toFrame(const base::Vec3& position,
                                              const contact::BodyMotion& motion) const;
    [[nodiscard]] contact::BodyMotion toRoom(const base::Vec3& position,
                                             const contact::BodyMotion& motion) const;
    /// The inertial forces over the coming step on a part of this mass [kg] and inertia (in the frame's axes
    /// [kg m^2]); gravity is not among them.
    [[nodiscard]] Wrench calcInertialForces(double mass, const base::Mat3& inertia,
                                            const base::Vec3& position,
                                            const contact::BodyMotion& motion) const;
    /// On to the next step.
    void advance();

 private:
    contact::DriveMotion drive_;
    double dt_;
    long steps_ = 0;
    contact::TrackPlacement now_;
    base::Vec3 velocity_, nextVelocity_;  // means of the step before and of the coming one [m/s]
    double turning_, nextTurning_;        // likewise, about z [rad/s]
};

}  // namespace trapwright::peers
