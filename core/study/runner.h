#pragma once

#include <functional>
#include <optional>

#include "core/base/result.h"
#include "core/study/evaluator.h"
#include "core/study/learning_control.h"
#include "core/study/records.h"

namespace trapwright::study {

/// Who watches a learning run. Called on the thread that runs it.
struct LearningEvents {
    /// A generation's tracks are built and its trials begin. May be empty.
    std::function<void(const GenerationPlan&)> planned;
    /// A generation is complete: keep it, in one transaction. An error ends the run.
    std::function<base::Status(const GenerationRecord&)> save;
};

enum class LearningEnd {
    completed,  // all generations of the settings are there
    stopped,    // after a whole generation, as asked
    cancelled   // at once; the unfinished generation was dropped
};

/// Learns until there are settings.evolution.generations (paper, section 3). Begins with a random population,
/// or goes on from `last`, the last generation that was saved: the next one depends on its genes and scores
/// and on the seed alone, so that any number of stops gives the same bits as none. Errors: settings or part
/// that cannot be used, engine, save.
base::Result<LearningEnd> evolve(const StudyInputs& inputs, std::optional<GenerationRecord> last,
                                 const LearningEvents& events, const LearningControl& control);

/// A generation's winner and statistics (Figures 6 and 7; decisions.md#distance-and-statistics). Strategy
/// values as they take effect, between their bounds.
GenerationRecord completeGeneration(int index, std::vector<IndividualRecord> individuals,
                                    const EvolutionSettings& settings);

}  // namespace trapwright::study
