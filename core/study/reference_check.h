#pragma once

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/evaluator.h"
#include "core/study/records.h"

namespace trapwright::study {

/// How many of a winner's trials are made again at most.
inline constexpr int kCheckTrials = 100;

/// How many of the winner's trials its check makes again, in each engine; 0 if it was not simulated and there
/// is nothing to check.
int countCheckTrials(const Individual& winner);

/// Simulates a generation's winner once more on the first of its own learning trials, in the engine of the
/// inputs, which learned, and in the reference: the same starts and streams, so that their scores may be
/// compared trial by trial. Depends on the winner alone, not on when it is called or what else was checked.
/// The winner has trials. Errors: settings or part that cannot be used, genes, engines, cancelled.
base::Result<CheckRecord> checkWinner(const StudyInputs& inputs, const trial::Engine& reference,
                                      const Individual& winner, const base::RunControl& control);

}  // namespace trapwright::study
