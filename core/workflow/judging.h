#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/run_control.h"
#include "core/store/study_file.h"
#include "core/study/evaluator.h"
#include "core/study/mending.h"
#include "core/study/robustness.h"
#include "core/study/stream.h"
#include "core/workflow/failure.h"

namespace trapwright::workflow {

/// The winners that a selection simulates again; of a planned study also the plan's best chain, the first
/// individual of generation 0, and of one that learns by exchanges instead what it went on from last: they
/// were put together from very many trials, and a generation's winner is the luckiest of many by few. Of a
/// study that trades two objectives those along its Pareto front (study::findParetoFront). A failure if
/// settings or part cannot be used, or there are no generations.
Result<std::vector<study::Individual>> findCandidates(const store::StudyFile& file,
                                                      const study::StudyInputs& inputs);

/// Ranks these by many trials each, and saves the result in the file.
Result<study::SelectionRecord> selectAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                             std::vector<study::Individual> candidates,
                                             const base::RunControl& control);

/// Trials of one validation.
std::int64_t countValidationTrials(const study::StudyInputs& inputs);

/// Validates one individual and saves the result in the file. `expected`: what counts as success, if
/// not what the settings say.
Result<study::ValidationRecord> validateAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                                const study::Individual& individual,
                                                const std::optional<trial::Goal>& expected,
                                                const base::RunControl& control);

/// Measures how robust an individual's track is, and saves the result in the file. `goal`: as
/// study::measureRobustness takes it.
Result<study::RobustnessRecord> measureAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                               const study::Individual& individual,
                                               const std::optional<trial::Goal>& goal,
                                               const study::RobustnessPlan& plan,
                                               const base::RunControl& control);

/// Simulates streams of parts on an individual's track, and saves the result in the file.
/// `goal`, `inflows`: as study::measureStreams takes them.
Result<study::StreamsRecord> measureStreamsAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                                   const study::Individual& individual,
                                                   const std::optional<trial::Goal>& goal,
                                                   const std::vector<double>& inflows,
                                                   const base::RunControl& control);

/// What mending a track gave; both are saved.
struct MendingReport {
    study::GenerationRecord generation;  // the variants that can be printed
    study::SelectionRecord selection;    // the best of them, and the track that they come from
    /// The best variant of the selection.
    study::IndividualId best;
    double unprintable = 0.0;  // of the track before [m^2]
};

/// Trials of a mending if all variants can be printed.
std::int64_t countMendingTrials(const study::Settings& settings, const study::MendingPlan& plan);

/// Mends an individual's track for the printer (study::mendVariants, judgeVariants), compares the best
/// variants with it by the trials of a selection, then saves generation and selection in the file and makes
/// the best variant the study's final track: what is cancelled leaves nothing. `saved` is told of the
/// generation; may be empty. Failures: nothing to mend (settings), no variant of which all can be printed
/// (notSolid), as the others.
Result<MendingReport> mendAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                  const study::Individual& track, const study::MendingPlan& plan,
                                  const std::function<void(const study::GenerationRecord&)>& saved,
                                  const base::RunControl& control);

}  // namespace trapwright::workflow
