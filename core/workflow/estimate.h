#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/evaluator.h"

namespace trapwright::workflow {

/// What a trial costs on this machine as it is now [s of wall time, all threads at work, the building of
/// tracks included].
struct TrialCost {
    double learning = 0.0;      // 0: not known
    double planning = 0.0;      // of a trap by itself, before generation 0; 0 where none is planned
    int ways = 0;               // in which parts come to a trap then
    bool ledgesFollow = false;  // as in study::PlanningSample
};

/// Times trials as this study learns by. Simulates for about `budget` seconds: random individuals, whose
/// parts often do not come far, and parts on the flat layout, which go all the way as on a good track; the
/// dearer of the two counts, so that the estimate does not grow while the tracks get better. Of a planned
/// study also traps at random by themselves. Errors: settings or part that cannot be used,
/// engine, cancelled.
base::Result<TrialCost> timeTrials(const study::StudyInputs& inputs, double budget,
                                   const base::RunControl& control);

/// How long so many generations take [s]; if they are all, with the planning of the first one. Checks by the
/// reference engine, which go on beside learning, are left out.
double learningTime(const study::EvolutionSettings& evolution, int generations, const TrialCost& cost);

/// Whether a trial costs the same with both: they differ in nothing but how many there are, and in what comes
/// after learning.
bool costTheSame(const study::Settings& a, const study::Settings& b);

/// What a draft may take at most [s], and for how much of it learning itself is planned: the rest is for
/// checks by the reference engine and for what an estimate misses.
inline constexpr double kDraftTime = 600.0;
inline constexpr double kDraftLearningTime = 450.0;

/// Learning cut down to `seconds`: the largest of some populations, with as many trials, that gets
/// generations enough to go with it, and no more of anything than `full` has; where the first generation is
/// planned, as many traps as there is time for, and two generations of 24 individuals with 100 trials, or,
/// of a search by exchanges, half of the time for traps and half for its generations. All
/// else stays. None if not even 10 generations of 20 individuals with 20 trials fit, or a plan of 500 traps.
std::optional<study::EvolutionSettings> fitEvolution(const study::EvolutionSettings& full, double seconds,
                                                     const TrialCost& cost);
/// The seconds below which that finds none; 0 if what a trial costs is not known.
double leastTime(const study::EvolutionSettings& full, const TrialCost& cost);

/// Table 1 of the paper again: population, trials and generations of a new study; all else stays.
study::EvolutionSettings fullEvolution(study::EvolutionSettings evolution);

}  // namespace trapwright::workflow
