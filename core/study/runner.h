#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/study/evaluator.h"
#include "core/study/records.h"

namespace trapwright::study {

/// Who watches a learning run. Called on the thread that runs it.
struct LearningEvents {
    /// A generation's tracks are built and its trials begin. May be empty.
    std::function<void(const GenerationPlan&)> planned;
    /// A generation is complete: keep it, in one transaction, or take away what is of no more use. An error
    /// ends the run.
    std::function<base::Status(GenerationRecord&)> save;
};

enum class LearningEnd {
    completed,  // all generations of the settings are there
    stopped,    // after a whole generation, as asked
    cancelled   // at once; the unfinished generation was dropped
};

/// Why the first generation cannot begin with these tracks, as the settings say that it shall; empty if it
/// can, or if it shall not.
std::string findKnownProblem(const Settings& settings, const KnownTracks& known);
/// How many of a first generation are known designs at most: half of it, so that others are there as well.
std::size_t countKnown(const EvolutionSettings& settings);

LearningState stateAfter(const GenerationRecord& last);

/// Learns until there are settings.evolution.generations (paper, section 3): the search that the settings
/// name proposes individuals, trials judge them, and the search is told. Begins anew, or goes on after
/// `last`: the next generation depends on the search's state and the settings alone, so that any number of
/// stops gives the same bits as none. Errors: settings or part that cannot be used, known tracks that are
/// none of theirs, a state that is none of theirs, engine, save.
base::Result<LearningEnd> evolve(const StudyInputs& inputs, const std::optional<LearningState>& last,
                                 const LearningEvents& events, const LearningControl& control);

/// A generation's winner and statistics (Figures 6 and 7; decisions.md#distance-and-statistics), with what
/// the search reports of it. `summed`: what counts in F.
GenerationRecord completeGeneration(int index, std::vector<IndividualRecord> individuals,
                                    std::vector<search::NamedNumber> curves,
                                    const objectives::ObjectiveList& summed);

}  // namespace trapwright::study
