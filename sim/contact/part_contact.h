#pragma once

#include <vector>

#include "core/trial/costs.h"
#include "core/trial/outcome.h"
#include "sim/contact/detector.h"
#include "sim/contact/drive_motion.h"
#include "sim/contact/impulse_solver.h"
#include "sim/contact/manifold.h"

namespace trapwright::contact {

/// The contact of one part with its vibrating track over the time steps of one trial: detection and the
/// discrete law together, for any engine that steps bodies.
class PartContact {
 public:
    PartContact(const ContactTrack& track, const ContactBody& body, const DriveMotion& drive,
                const trial::ContactParameters& law, double dt);

    /// Advances the track from step `step` (time step * dt) to the next. pose: part frame to room at the
    /// step's begin; inverseInertia: the part's, in part axes [1/(kg m^2)]; before, free: see ImpulseSolver.
    /// `laps` stands at the end of whatever came before.
    StepResult step(long step, const base::Pose& pose, double inverseMass, const base::Mat3& inverseInertia,
                    const BodyMotion& before, const BodyMotion& free, trial::CostLaps& laps);

    /// The part's pose relative to the track at the step that step() would take next.
    [[nodiscard]] base::Pose poseInTrack(const base::Pose& pose) const { return now_.toTrack(pose); }
    /// What the contacts of the last step did to the part, mean over the step.
    [[nodiscard]] std::vector<trial::ContactForce> forces() const;
    /// Contacts of the last step.
    [[nodiscard]] const std::vector<Contact>& contacts() const { return points_; }

 private:
    /// Of a rough track those contacts that stand for all, each pressed its grain's way.
    void roughen();

    const ContactBody* body_;
    DriveMotion drive_;
    trial::ContactParameters law_;
    double dt_;
    Detector detector_;
    ImpulseSolver solver_;
    TrackPlacement before_, now_, next_;
    double lastReach_ =
        0.0;  // how far any point of the part may have moved relative to the track in the last step [m]
    std::vector<Contact> points_;
    std::vector<ManifoldPoint> manifold_;
    std::vector<MovingContact> stepContacts_;
};

}  // namespace trapwright::contact
