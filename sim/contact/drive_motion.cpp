#include "sim/contact/drive_motion.h"

#include <cmath>

namespace trapwright::contact {

base::Pose TrackPlacement::toRoom(const base::Pose& pose) const {
    const double half = 0.5 * std::atan2(sine, cosine);
    return {base::Quaternion(std::cos(half), 0.0, 0.0, std::sin(half)) * pose.rotation,
            toRoom(pose.position)};
}

base::Pose TrackPlacement::toTrack(const base::Pose& pose) const {
    const double half = 0.5 * std::atan2(sine, cosine);
    return {base::Quaternion(std::cos(half), 0.0, 0.0, -std::sin(half)) * pose.rotation,
            toTrack(pose.position)};
}

DriveMotion::DriveMotion(const trial::Vibration& drive, const track::FeederShape& shape, double phase)
    : angularFrequency_(drive.angularFrequency()),
      phase_(phase),
      along_(drive.halfStroke * std::cos(drive.angle)),
      up_(drive.halfStroke * std::sin(drive.angle)),
      turnScale_(0.0) {
    if (shape.type == track::FeederType::bowl)
        turnScale_ = (shape.conveying == track::Conveying::clockwise ? -1.0 : 1.0) / shape.bowlRadius;
}

DriveMotion::Amplitudes DriveMotion::amplitudes() const {
    if (turnScale_ == 0.0) return {along_, up_, 0.0};
    return {0.0, up_, turnScale_ * along_};
}

TrackPlacement DriveMotion::calcPlacement(const Amplitudes& amplitudes, double sine) {
    TrackPlacement placement;
    placement.shift = {amplitudes.along * sine, 0.0, amplitudes.up * sine};
    if (amplitudes.turn != 0.0) {
        placement.cosine = std::cos(amplitudes.turn * sine);
        placement.sine = std::sin(amplitudes.turn * sine);
    }
    return placement;
}

base::Vec3 DriveMotion::displacement(double time) const {
    const double s = std::sin(angularFrequency_ * time + phase_);
    return {along_ * s, 0.0, up_ * s};
}

TrackPlacement DriveMotion::placement(double time) const {
    return calcPlacement(amplitudes(), std::sin(angularFrequency_ * time + phase_));
}

}  // namespace trapwright::contact
