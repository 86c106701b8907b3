#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/search/design_space.h"
#include "core/study/evaluator.h"

namespace trapwright::study {

/// Chains of traps put together from what each trap does by itself, before anything is learned (learning.md).
/// Parts that lie in a groove do so in a few ways: a stable pose, a heading. A trap between two grooves takes
/// each way to others, or throws parts out of it, with probabilities that a few trials from each way measure:
/// a transition matrix, as Boothroyd (2005) tells the effect of a feeder's devices. What a chain does is then
/// the product of its matrices, without a trial, so that few traps measured by themselves tell of very many
/// chains.

/// Why a chain of these traps cannot be planned; empty if it can. It begins with two grooves, in which parts
/// come to lie down and to move on, and goes on with drops, cut-outs, gaps and slots; or all of it are
/// ledges, of which the first is left whole, also behind a trap that is given; or ledges follow such grooves.
std::string findPlanningProblem(const TrackSettings& settings);

/// The best chains that were found, at most `most`, best first, no two alike: by the disorder of the parts'
/// ends, or by the share that lies as it is wanted where parts lie so behind the grooves; if the settings sum
/// up the objective sorting by that of those that stay on the track. A long chain of ledges for purity, eight
/// or more, ends with its last planned one twice more. For purity and yield of 1000 traps or more two plans
/// are made by themselves (decisions.md#returns).
/// Where ledges follow grooves what is before them is planned first, with half of the traps, so that as
/// many parts as can be come to one way, and then the ledges behind the best of it (decisions.md#ledges). The
/// best of them are judged by trials of whole tracks in the end, in a race, by what the study maximises.
/// About evolution.plannedTraps traps are tried; the same settings give the same designs. `planned` is told
/// of the work as of generation 0. Errors: traps that cannot be planned, parts that come to the
/// first of them in no way more than once in 75 times or in none that is wanted (ErrorKind::unattainable),
/// engine, cancelled, or stopped: there is no generation to wait for.
base::Result<std::vector<search::Design>> planDesigns(
    const StudyInputs& inputs, std::size_t most, const std::function<void(const GenerationPlan&)>& planned,
    const LearningControl& control);
/// How many of a first generation are planned designs: half of it.
std::size_t countPlanned(const EvolutionSettings& settings);

/// What a plan meets on this machine.
struct PlanningSample {
    int ways = 0;               // in which parts lie when they come to the first trap
    double seconds = 0.0;       // of a trial of a trap by itself, all threads at work
    bool ledgesFollow = false;  // grooves, which are planned first
};
/// Simulates some hundred parts up to the first trap, then traps at random for about `budget` seconds. The
/// settings must be those of a planned study. Errors: engine, cancelled.
base::Result<PlanningSample> samplePlanning(const StudyInputs& inputs, double budget,
                                            const base::RunControl& control);
/// Trials of traps by themselves that a plan takes where parts lie in so many ways; 0 if these settings plan
/// none. An estimate. `ledgesFollow`: as in PlanningSample.
std::int64_t estimatePlanningTrials(const EvolutionSettings& settings, int ways, bool ledgesFollow = false);
/// Trials of whole tracks by which a plan's best chains are judged; 0 if these settings plan none.
std::int64_t estimateJudgingTrials(const EvolutionSettings& settings, bool ledgesFollow = false);

/// Whether generation 0 is planned.
bool isPlanned(const EvolutionSettings& settings);

}  // namespace trapwright::study
