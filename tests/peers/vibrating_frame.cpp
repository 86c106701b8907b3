#include "tests/peers/vibrating_frame.h"

#include <cmath>

namespace trapwright::peers {

using base::Mat3;
using base::Vec3;
using contact::BodyMotion;

namespace {

double angleOf(const contact::TrackPlacement& placement) {
    return std::atan2(placement.sine, placement.cosine);
}

}  // namespace

VibratingFrame::VibratingFrame(const trial::TrialBatch& batch, std::size_t trial, double dt)
    : drive_(batch.driveOf(batch.trials[trial]), batch.track->shape, batch.trials[trial].phase),
      dt_(dt),
      now_(drive_.placement(0.0)) {
    const contact::TrackPlacement before = drive_.placement(-dt);
    const contact::TrackPlacement next = drive_.placement(dt);
    velocity_ = (now_.shift - before.shift) / dt;
    nextVelocity_ = (next.shift - now_.shift) / dt;
    turning_ = (angleOf(now_) - angleOf(before)) / dt;
    nextTurning_ = (angleOf(next) - angleOf(now_)) / dt;
}

BodyMotion VibratingFrame::toFrame(const Vec3& position, const BodyMotion& motion) const {
    const Vec3 turning = turning_ * Vec3::UnitZ();
    return {now_.turnBack(motion.velocity - velocity_) - turning.cross(position),
            now_.turnBack(motion.angularVelocity) - turning};
}

BodyMotion VibratingFrame::toRoom(const Vec3& position, const BodyMotion& motion) const {
    const Vec3 turning = turning_ * Vec3::UnitZ();
    return {now_.turn(motion.velocity + turning.cross(position)) + velocity_,
            now_.turn(motion.angularVelocity + turning)};
}

Wrench VibratingFrame::calcInertialForces(double mass, const Mat3& inertia, const Vec3& position,
                                          const BodyMotion& motion) const {
    // A linear drive does not turn, a helical one shifts along its axis: shifts keep their direction.
    const Vec3 acceleration = (nextVelocity_ - velocity_) / dt_;
    const Vec3 turning = 0.5 * (turning_ + nextTurning_) * Vec3::UnitZ();
    const Vec3 angularAcceleration = (nextTurning_ - turning_) / dt_ * Vec3::UnitZ();
    const Vec3& spin = motion.angularVelocity;
    Wrench wrench;
    wrench.force = -mass * (acceleration + angularAcceleration.cross(position) +
                            2.0 * turning.cross(motion.velocity) + turning.cross(turning.cross(position)));
    // Euler's equation for the sum of both spins, less what the simulator knows by itself.
    wrench.torque = -inertia * angularAcceleration - spin.cross(inertia * turning) +
                    inertia * spin.cross(turning) - turning.cross(inertia * (spin + turning));
    return wrench;
}

void VibratingFrame::advance() {
    ++steps_;
    const contact::TrackPlacement later = drive_.placement(static_cast<double>(steps_ + 1) * dt_);
    now_ = drive_.placement(static_cast<double>(steps_) * dt_);
    velocity_ = nextVelocity_;
    turning_ = nextTurning_;
    nextVelocity_ = (later.shift - now_.shift) / dt_;
    nextTurning_ = (angleOf(later) - angleOf(now_)) / dt_;
}

}  // namespace trapwright::peers
