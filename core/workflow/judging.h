#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/run_control.h"
#include "core/store/study_file.h"
#include "core/study/evaluator.h"
#include "core/study/robustness.h"
#include "core/workflow/failure.h"

namespace trapwright::workflow {

/// The winners that a selection simulates again; of a planned study also the plan's best chain, the first
/// individual of generation 0: it was put together from very many trials, and a generation's winner is the
/// luckiest of many by few. A failure if settings or part cannot be used, or there are
/// no generations.
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

}  // namespace trapwright::workflow
