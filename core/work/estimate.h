#pragma once

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/evaluator.h"

namespace trapwright::work {

/// How long a whole learning run of these inputs will take [s], from the time that some individuals of its
/// first generation take; it simulates for about `budget` seconds. Later generations come farther and need
/// more time, or less: an estimate. Errors: settings or part that cannot be used, engine, cancelled.
base::Result<double> estimateLearning(const study::StudyInputs& inputs, double budget,
                                      const base::RunControl& control);

}  // namespace trapwright::work
