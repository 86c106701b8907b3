#pragma once

#include <optional>

#include "core/trial/batch.h"
#include "core/trial/outcome.h"

namespace trapwright::trial {

/// Follows one part along its track and says when and how its trial ends (paper, section 3.4;
/// decisions.md#endings). Engines call update() every few milliseconds of simulated time.
class TerminationMonitor {
 public:
    TerminationMonitor(const track::Track& track, const Termination& termination)
        : track_(&track), termination_(termination) {}

    /// `pose`: part frame to the track's mesh frame (the room with the drive's displacement taken out).
    /// Returns the ending when the trial is over; outcome() is then complete.
    std::optional<Ending> update(double time, const base::Pose& pose);

    [[nodiscard]] const Outcome& outcome() const { return outcome_; }

    /// The pose in track coordinates, rotation in the tangent frame there.
    [[nodiscard]] base::Pose toTrackCoordinates(const base::Pose& pose) const;

 private:
    [[nodiscard]] std::optional<Ending> findEnding(double time, const base::Vec3& position) const;

    const track::Track* track_;
    Termination termination_;
    Outcome outcome_;
    bool started_ = false;
    double lastX_ = 0.0;
    double markedX_ = 0.0;     // progress is measured from here ...
    double markedTime_ = 0.0;  // ... and was last made then
};

}  // namespace trapwright::trial
