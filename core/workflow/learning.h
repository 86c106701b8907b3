#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/store/study_file.h"
#include "core/study/evaluator.h"
#include "core/study/runner.h"
#include "core/trial/engine_registry.h"
#include "core/workflow/failure.h"
#include "core/workflow/winner_checks.h"

namespace trapwright::workflow {

/// Who watches a learning run. Called on the thread that learns; each may be empty.
struct LearnEvents {
    std::function<void(const study::GenerationPlan&)> planned;
    std::function<void(const study::GenerationRecord&)> saved;  // it is in the file, with its trials
    CheckSaved checked;                                         // likewise
};

/// How a learning run went.
struct LearningReport {
    study::LearningEnd end = study::LearningEnd::completed;
    std::int64_t trials = 0;  // of this run
    double seconds = 0.0;     // that it took
    std::vector<study::Individual>
        unchecked;  // winners that the reference has not checked yet; see checkWinners
};

/// Learns from the last generation in the file on and saves each in it. If the study's engine setting has a
/// reference, winners are checked meanwhile; what is left of that at the end is not waited for.
Result<LearningReport> learn(store::StudyFile& file, const study::StudyInputs& inputs,
                             const trial::EngineRegistry& engines, const LearnEvents& events,
                             const study::LearningControl& control);

/// The tracks of a study that another one can begin with: its final track, those of its last selection, and
/// all of its last generation, in that order and each once. An error if it has none, or cannot be read.
base::Result<study::KnownTracks> collectTracks(const store::StudyFile& from);

}  // namespace trapwright::workflow
