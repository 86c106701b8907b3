#pragma once

#include <memory>
#include <optional>

#include "core/trial/batch.h"
#include "core/trial/termination_monitor.h"
#include "sim/contact/trial_contact.h"
#include "sim/simbody/free_bodies.h"

namespace trapwright::simbody {

/// What all trials of one part in one batch share: the batch, its track and the part prepared for contact
/// detection.
struct Scene {
    Scene(const trial::TrialBatch& b, const part::Part& part);

    const trial::TrialBatch* batch;
    contact::ContactTrack track;
    contact::ContactBody body;
};

/// One running trial in one body of a FreeBodies.
class TrialLane {
 public:
    /// Places the part in `slot` of `bodies`.
    TrialLane(std::shared_ptr<const Scene> scene, std::size_t trial, FreeBodies& bodies, int slot, double dt);

    /// Between FreeBodies::beginStep and endStep: checks for the end, then lets the contacts act.
    /// Returns the ending when the trial is over; the step is then not taken.
    std::optional<trial::Ending> step(FreeBodies& bodies, int slot, trial::CostLaps& laps);

    [[nodiscard]] const trial::Outcome& outcome() const { return progress_.outcome(); }
    [[nodiscard]] double time() const { return static_cast<double>(steps_) * dt_; }

    /// The moment at the begin of the coming step, or with `ended` of the last one.
    [[nodiscard]] trial::TrajectorySample sample(const FreeBodies& bodies, int slot) const;

 private:
    std::shared_ptr<const Scene> scene_;
    double dt_;
    long steps_ = 0;
    long stepsPerCheck_;
    contact::DriveMotion drive_;
    contact::TrialContact contact_;
    trial::TerminationMonitor progress_;
    int carrying_ = 0;
};

}  // namespace trapwright::simbody
