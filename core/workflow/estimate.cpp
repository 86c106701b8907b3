#include "core/workflow/estimate.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/search/racing.h"
#include "core/study/evaluator.h"
#include "core/study/planning.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"

namespace trapwright::workflow {

namespace {

/// A population, as many trials or so, and how many generations it must get to be better than a smaller one.
struct Size {
    int population = 0;
    int trials = 0;
    int generations = 0;
};
constexpr std::array<Size, 8> kSizes = {{{400, 400, 200},
                                         {200, 200, 200},
                                         {100, 100, 25},
                                         {80, 60, 25},
                                         {60, 50, 25},
                                         {40, 40, 25},
                                         {30, 30, 25},
                                         {20, 20, 10}}};
constexpr int kTimedTrials = 40;  // each, at most: a draft has no more, and its tracks are built as often

/// Calls `simulate` with more and more, until what it does takes about `budget` seconds. Seconds for one.
base::Result<double> timeOne(double budget, std::size_t first, std::size_t most,
                             const std::function<base::Status(std::size_t count)>& simulate) {
    using Clock = std::chrono::steady_clock;
    std::size_t count = std::min(first, most);
    while (true) {
        const Clock::time_point begin = Clock::now();
        const base::Status done = simulate(count);
        if (!done) return done.error();
        const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        if (2.0 * seconds >= budget || count == most) return seconds / static_cast<double>(count);
        // As many as should take what is left; the next pass is the last or nearly so.
        const double factor = std::clamp(budget / std::max(seconds, 1e-3), 2.0, 16.0);
        count = std::min(most, static_cast<std::size_t>(factor * static_cast<double>(count)));
    }
}

base::Result<double> timeRandomTracks(const study::StudyInputs& inputs, double budget,
                                      const base::RunControl& control) {
    const auto proposals = study::makeSearch(inputs.settings)->ask();
    // The more at once, the better all threads are used, as they will be by a whole generation.
    const auto each = timeOne(
        budget, std::size_t{2} * inputs.threads, proposals.size(), [&](std::size_t count) -> base::Status {
            const auto some = study::evaluateGeneration(
                inputs, 0, std::span(proposals).first(count), [](const study::GenerationPlan&) {}, control);
            if (!some) return some.error();
            return base::success();
        });
    if (!each) return each.error();
    return *each / inputs.settings.evolution.trialsPerEvaluation;
}

base::Result<double> timeLayout(const study::StudyInputs& inputs, double budget,
                                const base::RunControl& control) {
    auto track = study::buildLayout(inputs.settings.track);
    if (!track) return track.error();
    const auto flat = std::make_shared<const track::Track>(std::move(*track));
    study::SimulationSettings simulation = inputs.settings.simulation;
    simulation.termination.stuckTime = inputs.settings.evolution.learningStuckTime;
    constexpr std::size_t kMost = 20000;
    return timeOne(budget, std::size_t{16} * inputs.threads, kMost, [&](std::size_t count) -> base::Status {
        trial::TrialBatch batch = study::makeTrackBatch(
            flat, inputs.part, simulation, inputs.settings.evolution.seed, static_cast<int>(count));
        batch.step = study::chooseLearningStep(inputs.settings);
        const auto outcomes = study::runTrials(*inputs.engine, std::span(&batch, 1), control);
        if (!outcomes) return outcomes.error();
        return base::success();
    });
}

/// Of the race that a generation is, if its ranking stays as it begins. Any numbers may have been set.
std::int64_t countTrials(const study::EvolutionSettings& evolution) {
    const auto population = static_cast<std::size_t>(std::max(evolution.populationSize, 0));
    const bool isShare = evolution.racingShare >= 0.0 && evolution.racingShare <= 1.0;
    return search::countRacingTrials(search::makeRacingStages(population, evolution.racingTrials,
                                                              evolution.trialsPerEvaluation,
                                                              isShare ? evolution.racingShare : 1.0));
}

/// Before there is a generation. [s]
double planningTime(const study::EvolutionSettings& evolution, const TrialCost& cost) {
    const std::int64_t traps = study::estimatePlanningTrials(evolution, cost.ways, cost.ledgesFollow);
    const std::int64_t chains = study::estimateJudgingTrials(evolution, cost.ledgesFollow);
    return static_cast<double>(traps) * cost.planning + static_cast<double>(chains) * cost.learning;
}

int fewestTraps(const study::EvolutionSettings& full) {
    constexpr int kFewest = 500;
    return std::min(full.plannedTraps, kFewest);
}

/// What follows a plan, at the least: two generations, as those that are bred gain little. Exchanges keep
/// their population.
study::EvolutionSettings cutDownPlanned(const study::EvolutionSettings& full) {
    constexpr int kGenerations = 2;
    constexpr int kPopulation = 24;
    constexpr int kTrials = 100;
    const bool exchanges = full.search == search::Method::exchange;
    study::EvolutionSettings fitted = full;
    fitted.generations = std::min(full.generations, kGenerations);
    if (!exchanges) fitted.populationSize = std::min(full.populationSize, kPopulation);
    // Nines are told by many trials.
    if (!objectives::contains(study::summedObjectives(full), objectives::kPurity))
        fitted.trialsPerEvaluation = std::min(full.trialsPerEvaluation, kTrials);
    fitted.racingTrials = std::min(fitted.racingTrials, fitted.trialsPerEvaluation);
    fitted.tournamentSize = std::min(fitted.tournamentSize, fitted.populationSize);
    return fitted;
}

/// As many traps as take `seconds` to plan with. Exchanges gain more than generations that are bred: they get
/// half of the time.
std::optional<study::EvolutionSettings> fitPlanned(const study::EvolutionSettings& full, double seconds,
                                                   const TrialCost& cost) {
    const bool exchanges = full.search == search::Method::exchange;
    study::EvolutionSettings fitted = cutDownPlanned(full);
    const auto timeOf = [&](int traps) {
        fitted.plannedTraps = traps;
        return learningTime(fitted, fitted.generations, cost);
    };
    const auto trapsIn = [&](double time) {
        int count = 0;
        for (int tooMany = full.plannedTraps + 1; tooMany - count > 1;) {
            const int middle = std::midpoint(count, tooMany);
            (timeOf(middle) <= time ? count : tooMany) = middle;
        }
        return count;
    };
    const int fewest = fewestTraps(full);
    int count = trapsIn(seconds);
    if (count < fewest) return std::nullopt;
    if (exchanges) count = std::max(fewest, trapsIn(0.5 * seconds));
    const double left = seconds - timeOf(count);
    if (exchanges) {
        const double exchanging = learningTime(fitted, 1, cost);
        fitted.generations += static_cast<int>(
            std::clamp<double>(std::floor(left / exchanging), 0.0, full.generations - fitted.generations));
    }
    return fitted;
}

}  // namespace

base::Result<TrialCost> timeTrials(const study::StudyInputs& inputs, double budget,
                                   const base::RunControl& control) {
    if (const auto checked = study::checkInputs(inputs); !checked) return checked.error();
    study::StudyInputs timed = inputs;
    study::EvolutionSettings& evolution = timed.settings.evolution;
    const bool isPlanned = study::isPlanned(evolution);
    const double each = budget / (isPlanned ? 3.0 : 2.0);
    // Of the few tracks that are timed a race would run nearly all to its end.
    evolution.racingTrials = 0;
    evolution.trialsPerEvaluation = std::min(evolution.trialsPerEvaluation, kTimedTrials);
    const auto random = timeRandomTracks(timed, each, control);
    if (!random) return random.error();
    const auto flat = timeLayout(timed, each, control);
    if (!flat) return flat.error();
    TrialCost cost{std::max(*random, *flat), 0.0, 0};
    if (!isPlanned) return cost;
    const auto sample = study::samplePlanning(timed, each, control);
    if (!sample) return sample.error();
    cost.planning = sample->seconds;
    cost.ways = sample->ways;
    cost.ledgesFollow = sample->ledgesFollow;
    return cost;
}

double learningTime(const study::EvolutionSettings& evolution, int generations, const TrialCost& cost) {
    double time = static_cast<double>(countTrials(evolution)) * generations * cost.learning;
    if (generations >= evolution.generations) time += planningTime(evolution, cost);
    return time;
}

bool costTheSame(const study::Settings& a, const study::Settings& b) {
    study::Settings same = b;
    same.evolution.populationSize = a.evolution.populationSize;
    same.evolution.trialsPerEvaluation = a.evolution.trialsPerEvaluation;
    same.evolution.generations = a.evolution.generations;
    same.evolution.plannedTraps = a.evolution.plannedTraps;
    study::takePoseWeights(same.part, a.part);
    same.validation = a.validation;
    same.feeder = a.feeder;
    return same == a;
}

std::optional<study::EvolutionSettings> fitEvolution(const study::EvolutionSettings& full, double seconds,
                                                     const TrialCost& cost) {
    if (!(cost.learning > 0.0)) return std::nullopt;
    if (study::isPlanned(full)) return fitPlanned(full, seconds, cost);
    for (const Size& size : kSizes) {
        const int population = std::min(size.population, full.populationSize);
        const int each = std::min(size.trials, full.trialsPerEvaluation);
        const double generations =
            std::floor(seconds / (static_cast<double>(population) * each * cost.learning));
        if (!(generations >= std::min(size.generations, full.generations))) continue;
        study::EvolutionSettings fitted = full;
        fitted.populationSize = population;
        fitted.trialsPerEvaluation = each;
        fitted.racingTrials = std::min(fitted.racingTrials, each);
        fitted.tournamentSize = std::min(fitted.tournamentSize, population);
        fitted.generations = static_cast<int>(std::min<double>(generations, full.generations));
        return fitted;
    }
    return std::nullopt;
}

double leastTime(const study::EvolutionSettings& full, const TrialCost& cost) {
    if (study::isPlanned(full)) {
        study::EvolutionSettings fitted = cutDownPlanned(full);
        fitted.plannedTraps = fewestTraps(full);
        return learningTime(fitted, fitted.generations, cost);
    }
    double least = std::numeric_limits<double>::infinity();
    for (const Size& size : kSizes)
        least = std::min(least, static_cast<double>(std::min(size.population, full.populationSize)) *
                                    std::min(size.trials, full.trialsPerEvaluation) *
                                    std::min(size.generations, full.generations) * cost.learning);
    return least;
}

study::EvolutionSettings fullEvolution(study::EvolutionSettings evolution) {
    const study::EvolutionSettings table;
    evolution.populationSize = table.populationSize;
    evolution.trialsPerEvaluation = table.trialsPerEvaluation;
    evolution.generations = table.generations;
    return evolution;
}

}  // namespace trapwright::workflow
