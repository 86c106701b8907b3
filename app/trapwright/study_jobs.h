#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/trapwright/console.h"
#include "app/trapwright/exit_codes.h"
#include "app/trapwright/study_access.h"
#include "core/store/study_file.h"
#include "core/study/evaluator.h"
#include "core/study/records.h"
#include "core/workflow/failure.h"
#include "core/workflow/study_trials.h"

namespace trapwright::app {

/// The same failure with the status that it ends the program with.
Failure toFailure(const workflow::Failure& failure);
/// The same of a failure while this study was worked on. If its file is gone, a copy is made of what it held,
/// and the message tells where.
Failure toFailure(const workflow::Failure& failure, const store::StudyFile& file);

/// Selection of a study's winners with progress and Ctrl-C, its result saved in the file.
Attempt<study::SelectionRecord> selectAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                              const Console& console);

/// Validation of one individual likewise. `expected`: what counts as success, if not what the settings say.
Attempt<study::ValidationRecord> validateAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                                 const study::Individual& individual,
                                                 const std::optional<trial::Goal>& expected,
                                                 const Console& console);

/// Success by each condition that the trials of a selection or validation varied over: printed, and added to
/// the command's document as "conditions". Nothing if they were all alike.
Attempt<ExitCode> addSlices(const OpenStudy& study, const workflow::TrialsRequest& request,
                            const Console& console, nlohmann::ordered_json& document);

/// A line on stderr about the trials that were made again, if there are any.
void noteRemadeTrials(const study::StudyInputs& inputs, const Console& console);
/// Adds them to a command's document as "remade_trials", if there are any.
void addRemadeTrials(const study::StudyInputs& inputs, nlohmann::ordered_json& document);

/// The failure that a cancelled or broken run of trials means.
Failure describeRunFailure(const base::RunControl& control, const base::Error& error);

}  // namespace trapwright::app
