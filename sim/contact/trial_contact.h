#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/trial/costs.h"
#include "core/trial/outcome.h"
#include "sim/contact/detector.h"
#include "sim/contact/drive_motion.h"
#include "sim/contact/impulse_solver.h"
#include "sim/contact/manifold.h"
#include "sim/contact/part_pairs.h"

namespace trapwright::contact {

/// A part at the begin of a step, as the engine that steps it has it.
struct SteppedPart {
    base::Pose pose;            // part frame to room
    double inverseMass = 1.0;   // [1/kg]
    base::Mat3 inverseInertia;  // in part axes [1/(kg m^2)]
    BodyMotion before, free;    // see MovingBody
};

/// The contacts of the parts of one trial with their vibrating track and with each other, over its time
/// steps: detection and the discrete law together, for any engine that steps bodies. Each part has a slot as
/// long as it is there; bodies of contacts are slots.
class TrialContact {
 public:
    TrialContact(const ContactTrack& track, const DriveMotion& drive, const ContactLaws& laws, double dt);

    /// A part comes into a slot that is free; they are numbered from 0 without gaps.
    void add(int slot, const ContactBody& body);
    void remove(int slot);
    /// Slots, those that are free among them.
    [[nodiscard]] int slotCount() const { return static_cast<int>(parts_.size()); }

    /// Advances the track from step `step` (time step * dt) to the next. `parts`: of all slots; what free
    /// ones have is not looked at. Slot i of the result is for slot i; valid until the next call. `laps`
    /// stands at the end of whatever came before.
    std::span<const StepResult> step(long step, std::span<const SteppedPart> parts, trial::CostLaps& laps);

    /// A part's pose relative to the track at the step that step() would take next.
    [[nodiscard]] base::Pose poseInTrack(const base::Pose& pose) const { return now_.toTrack(pose); }
    /// Where the track is at that step.
    [[nodiscard]] const TrackPlacement& placement() const { return now_; }
    /// What the contacts of the last step did to the parts, mean over the step.
    [[nodiscard]] std::vector<trial::ContactForce> forces() const;
    /// Contacts of the last step.
    [[nodiscard]] const std::vector<Contact>& contacts() const { return points_; }

 private:
    struct Part {
        Detector detector;
        const ContactBody* body;
        BodyMotion lastAdvance;  // of the last step
        double lastTurn = 0.0;   // how far any point of it may have come by turning, in the last step [m]
        double lastReach = 0.0;  // the same by all motion relative to the track [m]
        double turn = 0.0;       // of the coming step, if nothing touches [m]
    };

    void findTrackContacts(int slot, const SteppedPart& part);
    void findPairContacts(std::span<const SteppedPart> parts);
    /// Of a rough track those contacts that stand for all, each pressed its grain's way.
    void roughen(std::vector<Contact>& contacts);

    ContactLaws laws_;
    DriveMotion drive_;
    double dt_;
    const ContactTrack* track_;
    ImpulseSolver solver_;
    TrackPlacement before_, now_, next_;
    std::vector<std::optional<Part>> parts_;
    PartPairs pairs_;
    std::vector<base::Vec3> positions_;
    std::vector<NearPart> nearParts_;
    std::vector<PartContact> partContacts_;
    std::vector<Contact> points_, found_;
    std::vector<ManifoldPoint> manifold_;
    std::vector<MovingContact> stepContacts_;
    std::vector<MovingBody> bodies_;
    std::vector<StepResult> results_;
};

}  // namespace trapwright::contact
