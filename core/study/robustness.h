#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/evaluator.h"
#include "core/study/operating_box.h"
#include "core/track/track.h"
#include "core/trial/goal.h"

namespace trapwright::study {

/// How much is simulated to find out how robust a track is.
struct RobustnessPlan {
    int trials = 200;      // of each single place
    int boxTrials = 1000;  // all over the box
    int sweepPoints = 7;   // of each condition that varies, from end to end of its range
    int mapPoints = 5;     // in each direction of the worst pair's map; its places have half of the trials

    /// An error that names what is out of range.
    [[nodiscard]] base::Status check() const;
};

/// Trials of a track where the physics is not quite what was set: trial i has the same start at all places,
/// so that differences are the conditions'.
struct PlaceTrials {
    std::optional<trial::BoxPlace> place;  // none: each trial somewhere else in the box
    int first = 0;
    int count = 0;

    friend bool operator==(const PlaceTrials&, const PlaceTrials&) = default;
};

/// What they came to.
struct PlaceResult {
    PlaceTrials trials;
    trial::Tally tally;
    double speed = 0.0;  // mean along the track of the parts that finish [m/s]; 0 if none does
};

/// Success over one condition, all others as they are set.
struct ConditionSweep {
    trial::Condition condition = trial::Condition::friction;
    std::vector<PlaceResult> points;  // by rising condition
};

/// Success over two conditions, all others as they are set.
struct PairMap {
    trial::Condition across = trial::Condition::friction;
    trial::Condition up = trial::Condition::friction;
    int points = 0;                   // in each direction
    std::vector<PlaceResult> places;  // row by row, from low to high
};

/// How a track does where the physics is not quite what was set.
struct Robustness {
    trial::Goal goal;     // what counts as success
    PlaceResult nominal;  // as set
    PlaceResult overBox;
    std::vector<ConditionSweep> sweeps;  // of all conditions that vary
    std::vector<PlaceResult>
        corners;  // the worst four of all corners of the box, on fresh trials, worst first
    std::optional<PairMap> worstPair;  // the two conditions whose common corners are worst; none of fewer
};

/// The same of an individual of a study.
struct RobustnessRecord : IndividualId {
    std::string engine;
    trial::OperatingBox box;  // that it was measured in
    Robustness robustness;
};

/// As studies keep it.
std::string robustnessToJson(const Robustness& robustness);
/// An error if it is none.
base::Result<Robustness> robustnessFromJson(const std::string& text);

trial::TrialBatch makePlaceBatch(const Settings& settings, const std::shared_ptr<const part::Part>& part,
                                 const std::shared_ptr<const track::Track>& track, const PlaceTrials& trials);

/// How many trials that takes; 0: the box has no room.
std::int64_t countRobustnessTrials(const Settings& settings, const RobustnessPlan& plan);

/// Simulates the track all over the settings' operating box: as set, over the box at random, over each
/// condition, in all its corners (a few trials each; the worst again on fresh ones, since the worst of many
/// counts is an unlucky one), and the map of the worst two conditions. What counts as success is
/// what is given, or else what the settings want, or else the mode as set. Errors: settings, a box without
/// room, the engine's, cancelled.
base::Result<Robustness> measureRobustness(const StudyInputs& inputs,
                                           const std::shared_ptr<const track::Track>& track,
                                           const std::optional<trial::Goal>& given,
                                           const RobustnessPlan& plan, base::RunControl control);

/// A table of all of it, for people.
std::string formatRobustness(const StudyInputs& inputs, const Robustness& robustness);

/// The places of the box with one condition between two shares of its range, all others anywhere.
struct BoxSlice {
    trial::Condition condition = trial::Condition::friction;
    double low = 0.0;   // belongs to it
    double high = 1.0;  // belongs to the next one; 1 to this

    [[nodiscard]] bool holds(const trial::BoxPlace& place) const {
        const double share = place[static_cast<std::size_t>(condition)];
        return share >= low && (share < high || high >= 1.0);
    }
    friend bool operator==(const BoxSlice&, const BoxSlice&) = default;
};

/// Trials whose condition is in this slice of its range.
struct ConditionSlice {
    BoxSlice places;
    double low = 0.0;  // in SI, as conditionAt() tells it
    double high = 0.0;
    trial::Tally tally;
};

/// Trials all over the box by one of its conditions.
struct SlicedCondition {
    trial::Condition condition = trial::Condition::friction;
    std::vector<ConditionSlice> slices;  // equally wide, rising
};

/// The same trials by each condition that varies: success "per condition" of what was tried all over the box.
/// places[i] and verdicts[i] are of one trial.
std::vector<SlicedCondition> sliceByCondition(const SimulationSettings& simulation,
                                              const trial::OperatingBox& box,
                                              std::span<const trial::BoxPlace> places,
                                              std::span<const trial::Verdict> verdicts);

/// "0.30 ... 0.40": a slice's range, with its unit.
std::string describeRange(trial::Condition condition, const ConditionSlice& slice);
/// A table of them, for people; empty if there are none.
std::string formatSlices(std::span<const SlicedCondition> conditions);

/// "Friction 0.30, half-stroke 0.704 mm": what varies, as it is at a place.
std::string describePlace(const Settings& settings, const trial::BoxPlace& place);

}  // namespace trapwright::study
