#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/trial/batch.h"
#include "core/trial/outcome.h"

namespace trapwright::trial {

/// Follows the parts of one trial along their track and says when and how the run of each ends (paper,
/// section 3.4; decisions.md#endings). Engines call update() every few milliseconds of simulated time.
class TerminationMonitor {
 public:
    /// Both must outlive it.
    TerminationMonitor(const TrialBatch& batch, const TrialSpec& spec)
        : batch_(&batch),
          spec_(&spec),
          track_(batch.track.get()),
          parts_(spec.parts.size()),
          running_(spec.parts.size()) {
        outcome_.parts.resize(spec.parts.size());
    }

    /// `part`: its place in TrialSpec::parts. `pose`: part frame to the track's mesh frame (the room with the
    /// drive's displacement taken out). Returns the ending when the part's run is over, which is then not
    /// told of any more. A pose that is not a number ends it as stuck, and stays in the outcome as the
    /// farthest. One that falls off inside the track is noted, too (PartOutcome::throughSurface).
    std::optional<Ending> update(std::size_t part, double time, const base::Pose& pose);

    /// A part that never came, because there was no room for it, is not waited for any more.
    void leaveOut(std::size_t part, double time);

    /// The trial is over when all runs are; outcome() is then complete.
    [[nodiscard]] bool isOver() const { return running_ == 0; }
    [[nodiscard]] const Outcome& outcome() const { return outcome_; }

    /// A part's pose in track coordinates, rotation in the tangent frame there.
    [[nodiscard]] base::Pose toTrackCoordinates(std::size_t part, const base::Pose& pose) const;

 private:
    struct Progress {
        bool started = false;
        double startTime = 0.0;
        double lastX = 0.0;
        double markedX = 0.0;     // progress is measured from here ...
        double markedTime = 0.0;  // ... and was last made then
    };

    [[nodiscard]] std::optional<Ending> findEnding(const Progress& progress, double time,
                                                   const base::Vec3& position) const;
    /// Notes that a part of a stream stood still since it was marked, if it did so for long enough.
    void noteStop(std::size_t part, const Progress& progress, double time);

    /// Whether the part's centre of mass and some of its material are inside the track: the centre alone may
    /// pass through where a hollow part tips over a border.
    [[nodiscard]] bool isInside(std::size_t part, const base::Pose& pose) const;

    const TrialBatch* batch_;
    const TrialSpec* spec_;
    const track::Track* track_;  // of the batch
    std::vector<Progress> parts_;
    std::size_t running_;
    Outcome outcome_;
};

}  // namespace trapwright::trial
