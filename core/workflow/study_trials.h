#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/part/part.h"
#include "core/store/study_file.h"
#include "core/study/records.h"
#include "core/study/robustness.h"
#include "core/study/settings.h"
#include "core/study/stream.h"
#include "core/trial/batch.h"
#include "core/trial/engine_registry.h"
#include "core/trial/goal.h"
#include "core/trial/outcome.h"

namespace trapwright::workflow {

enum class TrialKind { learning, selection, validation, robustness, stream };

/// Trials that a track's robustness was measured by.
struct RobustnessTrials {
    study::PlaceTrials trials;
    trial::OperatingBox box;  // that was measured in
    trial::Goal goal;         // what counted as success
    std::string engine;       // that measured

    friend bool operator==(const RobustnessTrials&, const RobustnessTrials&) = default;
};

/// Streams of one inflow.
struct StreamTrials {
    study::StreamSettings settings;            // with this inflow
    std::optional<trial::OperatingBox> box{};  // that they varied over; none: all alike
    trial::Goal goal;                          // what counted as success
    std::string engine;                        // that simulated them

    friend bool operator==(const StreamTrials&, const StreamTrials&) = default;
};

/// Which trials of a study are meant.
struct TrialsRequest {
    TrialKind kind = TrialKind::learning;
    study::Individual winner;  // or any other individual
    // Of validation trials: indices into the part's stable poses, whose trials follow each other.
    std::vector<int> poses = {0};
    int count = 0;                                 // the first ones; 0: as many as the study holds
    std::string engine{};                          // empty: the one that the study holds them of
    std::optional<RobustnessTrials> robustness{};  // of that kind; no study holds them
    std::optional<StreamTrials> stream{};          // likewise
};

/// Trials of an individual whose results a study holds, and the engine that ran them.
struct StoredTrials {
    int count = 0;  // 0 if there are none
    std::string engine;
    std::optional<trial::Goal> goal{};  // what counted as success; none if learning
    double tolerance = 0.0;             // of it [rad]
    // That they varied over, of a selection or validation; none: all alike. In learning as the settings say.
    std::optional<trial::OperatingBox> box{};
    std::vector<store::PackedOutcomes> kept{};  // all of them, one piece for each pose; none: not stored
};

/// Of a selection or validation the last one that the individual was in. `settings` are the study's.
base::Result<StoredTrials> findStoredTrials(const store::StudyFile& file, const study::Settings& settings,
                                            const trial::EngineRegistry& engines,
                                            const TrialsRequest& request);

/// These trials, made anew with the same bits. More than are stored only where they are numbered on: not of a
/// validation. None if there are none. An error if the track cannot be built.
base::Result<trial::TrialBatch> makeTrials(const study::Settings& settings,
                                           const std::shared_ptr<const part::Part>& part,
                                           const TrialsRequest& request, const StoredTrials& stored);

/// What the study holds of the trials of this batch, made by makeTrials(); none if it does not hold all of
/// them. An error if they are damaged.
base::Result<std::optional<trial::MadeOutcomes>> unpackTrials(const StoredTrials& stored,
                                                              const trial::TrialBatch& batch);

/// These trials of a selection or validation by each condition that they varied over; none if they were all
/// alike or their outcomes are not stored. An error if these are damaged.
base::Result<std::vector<study::SlicedCondition>> sliceTrials(const study::Settings& settings,
                                                              const std::shared_ptr<const part::Part>& part,
                                                              const TrialsRequest& request,
                                                              const StoredTrials& stored);

/// A trial that ended otherwise when it was simulated again.
struct OutcomeDifference {
    trial::PartOutcome stored;  // of the first part that ended otherwise
    trial::OutcomeMaker storedBy;
    trial::PartOutcome replayed;
    trial::OutcomeMaker replayedBy;
};

/// None if all that is stored has the same bits.
std::optional<OutcomeDifference> findDifference(const trial::Outcome& stored,
                                                const trial::OutcomeMaker& storedBy,
                                                const trial::Outcome& replayed,
                                                const trial::OutcomeMaker& replayedBy);

/// How the two ended, who made them, and what holds: some lines for people.
std::string describe(const OutcomeDifference& difference);

/// Trials and what each counts as.
struct JudgedTrials {
    trial::Goal goal;  // what counts as success
    /// Slot i for outcome i: of its part, or of a stream stuck if it ends jammed, else the worst of all parts
    /// that arrive or fall.
    std::vector<trial::Verdict> verdicts;
};

/// `goal`: what counts; without it the most frequent final orientation. `tolerance` [rad].
JudgedTrials judgeTrials(std::span<const trial::Outcome> outcomes, const part::SymmetryGroup& symmetry,
                         const std::optional<trial::Goal>& goal, double tolerance);

}  // namespace trapwright::workflow
