#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trapwright::search {

/// One step of the ladder that a race climbs.
struct RacingStage {
    int trials = 0;  // of an individual that has reached this stage
    int places = 0;  // the best so many of the population must have reached it

    friend bool operator==(const RacingStage&, const RacingStage&) = default;
};

/// The ladder: all individuals get `first` trials; the numbers double from stage to stage, as far as twice as
/// many are no more than `all`, and the last stage is `all`. The places shrink in equal proportions from the
/// whole population to `share` of it (rounded up). One stage, everything for everybody, if `first` is not
/// less than `all`, or 0 (no race).
std::vector<RacingStage> makeRacingStages(std::size_t population, int first, int all, double share);

/// An individual that goes on.
struct RacingStep {
    std::size_t individual = 0;
    int trials = 0;  // in all, when the step is done

    friend bool operator==(const RacingStep&, const RacingStep&) = default;
};

/// The next round of a race: who holds a place among the best by its trials so far, without having reached
/// the stage that this place asks for, goes on to its next stage. `trials` are those that each has; who shall
/// not run counts as having all. Empty when the race is over: then the best places of every stage are held by
/// individuals that have reached it, so that those with fewer trials rank below the last stage's places by
/// fitness alone.
std::vector<RacingStep> findNextRound(std::span<const double> fitnesses, std::span<const int> trials,
                                      std::span<const RacingStage> stages);

/// How many trials the race will take in all, those made or begun included, if no later round changes the
/// ranking. `running` of the individuals take part.
std::int64_t countRacingTrials(std::span<const int> trials, int running, std::span<const RacingStage> stages);
/// The same before it begins, if all of the population take part.
std::int64_t countRacingTrials(std::span<const RacingStage> stages);

}  // namespace trapwright::search
