#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/base/result.h"
#include "core/part/part.h"
#include "core/track/track.h"
#include "core/trial/conditions.h"
#include "core/trial/contact.h"
#include "core/trial/vibration.h"

namespace trapwright::trial {

/// When a trial ends (paper, section 3.4; decisions.md#endings).
struct Termination {
    double timeLimit = 10.0;      // simulated [s]
    double stuckTime = 1.5;       // without stuckProgress: stuck [s]
    double stuckProgress = 1e-3;  // along the track [m]
    /// Above 0 the trial is a stream (decisions.md#streams): it lasts until this time, whatever its parts do.
    /// Who stands still stays where it is, in the way of others, and there is no other time limit. [s]
    double until = 0.0;
};

/// Where and how one part of a trial starts: in this pose of the track at its mean position (room axes),
/// displaced with the track to where the drive has it then.
struct PartStart {
    std::size_t part = 0;  // which of the batch's
    base::Pose pose;       // part frame to room
    base::Vec3 velocity =
        base::Vec3::Zero();  // of the centre of mass in the room; at rest when learning [m/s]
    base::Vec3 angularVelocity = base::Vec3::Zero();  // in the room's axes [rad/s]
    /// When it comes; above 0, if others are where it would be, as soon as they are gone. [s]
    double time = 0.0;
};

/// One simulated run to be made.
struct TrialSpec {
    base::StreamKey stream;        // names the trial for ever; its starts were drawn from it
    double phase = 0.0;            // of the drive at time 0 [rad]
    std::vector<PartStart> parts;  // in the order in which they come
    // What this trial has instead of what its batch has (decisions.md#operating-box).
    std::optional<ContactParameters> contact{};  // of parts with the track
    std::optional<Vibration> drive{};
    std::optional<BoxPlace> place{};  // where in the operating box it got these; no engine looks at it
};

/// How many steps a period has at least, where nothing else is asked for.
inline constexpr double kStepsPerPeriod = 100.0;

/// One track and N trials on it. Immutable values.
struct TrialBatch {
    std::shared_ptr<const track::Track> track;
    std::vector<std::shared_ptr<const part::Part>> parts;  // kinds of parts that its trials place
    Vibration drive;
    ContactParameters contact;       // of parts with the track
    ContactParameters partsContact;  // of parts with each other
    Termination termination;
    double gravity = base::kStandardGravity;  // [m/s^2]
    double step = 0.0;  // of simulated time, in engines that go in equal steps; 0: the engine's own [s]
    std::vector<TrialSpec> trials;

    /// The step of an engine that was made to take `asked` (0: whatever is right) and takes `own` for slow
    /// drives: that of the batch, the one asked for, or `own` but at least a hundred steps in a period. By
    /// similarity that is as right at any frequency as at 50 Hz. [s]
    [[nodiscard]] double stepOf(double asked, double own) const {
        if (step > 0.0) return step;
        return asked > 0.0 ? asked : std::min(own, calcLongestStep(drive, kStepsPerPeriod));
    }

    /// In the room of the track's solid, which a sloped linear feeder tilts (decisions.md#slope). [m/s^2]
    [[nodiscard]] base::Vec3 gravityVector() const { return gravity * track->shape.down(); }

    // What one of its trials has.
    [[nodiscard]] const ContactParameters& contactOf(const TrialSpec& trial) const {
        return trial.contact ? *trial.contact : contact;
    }
    [[nodiscard]] const Vibration& driveOf(const TrialSpec& trial) const {
        return trial.drive ? *trial.drive : drive;
    }
    /// Of a trial of one part.
    [[nodiscard]] const part::Part& partOf(const TrialSpec& trial) const {
        return *parts[trial.parts.front().part];
    }
};

/// Whether a trial is of one part from time 0 on, which is what learning is made of.
[[nodiscard]] inline bool isOfOnePart(const TrialBatch& batch, const TrialSpec& trial) {
    return trial.parts.size() == 1 && trial.parts.front().time == 0.0 && batch.termination.until == 0.0;
}

/// Why no engine can simulate this batch, or its trial `index` alone; none if it can.
std::optional<base::Error> findProblem(const TrialBatch& batch);
std::optional<base::Error> findProblem(const TrialBatch& batch, std::size_t index);

/// Likewise for an engine that simulates trials of one part only (isOfOnePart).
std::optional<base::Error> findSinglePartProblem(const TrialBatch& batch, std::string_view engine);
std::optional<base::Error> findSinglePartProblem(const TrialBatch& batch, std::size_t index,
                                                 std::string_view engine);

}  // namespace trapwright::trial
