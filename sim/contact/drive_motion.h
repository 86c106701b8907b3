#pragma once

#include "core/base/math.h"
#include "core/track/feeder_shape.h"
#include "core/trial/vibration.h"

namespace trapwright::contact {

/// Where the vibrating track is: a point p of its mesh is at rotation about the room's z axis of p, plus
/// lift.
struct TrackPlacement {
    double cosine = 1.0;
    double sine = 0.0;
    base::Vec3 shift = base::Vec3::Zero();  // [m]

    [[nodiscard]] base::Vec3 turn(const base::Vec3& v) const {
        return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y(), v.z()};
    }
    [[nodiscard]] base::Vec3 turnBack(const base::Vec3& v) const {
        return {cosine * v.x() + sine * v.y(), -sine * v.x() + cosine * v.y(), v.z()};
    }
    [[nodiscard]] base::Vec3 toRoom(const base::Vec3& p) const { return turn(p) + shift; }
    [[nodiscard]] base::Vec3 toTrack(const base::Vec3& p) const { return turnBack(p - shift); }
    [[nodiscard]] base::Pose toRoom(const base::Pose& pose) const;
    [[nodiscard]] base::Pose toTrack(const base::Pose& pose) const;
};

/// The drive's prescribed motion in closed form: a translation along the vibration line (linear feeder), or
/// the helical oscillation about the bowl's axis that has this line at the bowl radius (decisions.md#bowl).
/// The same as Simbody's Slider or Screw mobilizer under Motion::Sinusoid, which the tests hold it against.
class DriveMotion {
 public:
    /// phase [rad] at time 0.
    DriveMotion(const trial::Vibration& drive, const track::FeederShape& shape, double phase);

    [[nodiscard]] TrackPlacement placement(double time) const;
    /// What the sine is multiplied by: a translation [m], and a rotation about the room's z axis [rad].
    struct Amplitudes {
        double along, up, turn;
    };
    [[nodiscard]] Amplitudes amplitudes() const;
    /// Where the track is when the sine has this value.
    static TrackPlacement calcPlacement(const Amplitudes& amplitudes, double sine);
    /// Displacement at the bowl radius: along conveying, 0, up. [m]
    [[nodiscard]] base::Vec3 displacement(double time) const;

 private:
    double angularFrequency_;
    double phase_;
    double along_;  // amplitudes [m]
    double up_;
    double turnScale_;  // [rad/m] of displacement along conveying; 0: linear
};

}  // namespace trapwright::contact
