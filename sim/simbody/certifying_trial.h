#pragma once

#include <memory>

#include "core/base/math.h"
#include "core/track/feeder_shape.h"
#include "core/trial/contact.h"
#include "core/trial/vibration.h"
#include "sim/contact/body_motion.h"
#include "sim/contact/contact_body.h"
#include "sim/contact/contact_track.h"

namespace trapwright::simbody {

/// What a certifying trial is made of.
struct CertifyingScene {
    const contact::ContactTrack* track;
    const contact::ContactBody* body;
    track::FeederShape shape;
    trial::Vibration drive;
    double phase;        // of the drive at time 0 [rad]
    double mass;         // [kg]
    base::Mat3 inertia;  // about the centre of mass, part axes [kg m^2]
    base::Vec3 gravity;  // in the room [m/s^2]
    trial::ContactParameters law;
};

/// One part on one track with the continuous form of the contact law as a Force::Custom, the drive as a
/// Slider or Screw mobilizer under Motion::Sinusoid, under Simbody's error-controlled Runge-Kutta-Merson
/// integrator. Shares the detector with the quick engine, but neither its law nor its stepping.
class CertifyingTrial {
 public:
    CertifyingTrial(const CertifyingScene& scene, const base::Pose& pose, const contact::BodyMotion& motion);
    ~CertifyingTrial();
    CertifyingTrial(CertifyingTrial&&) noexcept;
    CertifyingTrial& operator=(CertifyingTrial&&) noexcept;

    /// Integrates up to `time` [s]. Throws what Simbody throws.
    void advanceTo(double time);

    [[nodiscard]] base::Pose pose() const;  // part frame to room
    [[nodiscard]] base::Pose poseInTrack() const;
    [[nodiscard]] contact::BodyMotion motion() const;
    [[nodiscard]] const std::vector<trial::ContactForce>& forces() const;  // of the contacts that press

 private:
    struct Model;
    std::unique_ptr<Model> model_;
};

}  // namespace trapwright::simbody
