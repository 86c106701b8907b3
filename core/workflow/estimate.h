#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/evaluator.h"

namespace trapwright::workflow {

/// What a trial costs while this study learns, on this machine as it is now [s of wall time, all threads at
/// work, the building of tracks included]. Simulates for about `budget` seconds: half of it random
/// individuals, whose parts often do not come far, half parts on the flat layout, which go all the way as on
/// a good track. The dearer of the two counts, so that the estimate does not grow while the tracks get
/// better. Errors: settings or part that cannot be used, engine, cancelled.
base::Result<double> timeTrial(const study::StudyInputs& inputs, double budget,
                               const base::RunControl& control);

/// How long so many generations take when a trial takes `secondsPerTrial` [s]; if they are all, with the
/// planning of the first one. Checks by the reference
/// engine, which go on beside learning, are left out.
double learningTime(const study::EvolutionSettings& evolution, int generations, double secondsPerTrial);

/// Whether a trial costs the same with both: they differ in nothing but how many there are, and in what comes
/// after learning.
bool costTheSame(const study::Settings& a, const study::Settings& b);

/// What a draft may take at most [s], and for how much of it learning itself is planned: the rest is for
/// checks by the reference engine and for what an estimate misses.
inline constexpr double kDraftTime = 600.0;
inline constexpr double kDraftLearningTime = 450.0;

/// Learning cut down to kDraftLearningTime: the largest of some populations, with as many trials, that gets
/// 25 generations or more, and no more of anything than `full` has. All else stays. None if not even 10
/// generations of 20 individuals with 20 trials fit.
std::optional<study::EvolutionSettings> draftEvolution(const study::EvolutionSettings& full,
                                                       double secondsPerTrial);

/// Table 1 of the paper again: population, trials and generations of a new study; all else stays.
study::EvolutionSettings fullEvolution(study::EvolutionSettings evolution);

}  // namespace trapwright::workflow
