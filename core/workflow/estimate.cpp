#include "core/workflow/estimate.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>

#include "core/study/planning.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"

namespace trapwright::workflow {

namespace {

/// A draft's population and trials each, best first.
struct DraftSize {
    int population = 0;
    int trials = 0;
};
constexpr std::array<DraftSize, 6> kDraftSizes = {
    {{100, 100}, {80, 60}, {60, 50}, {40, 40}, {30, 30}, {20, 20}}};
constexpr int kEnoughGenerations = 25;
constexpr int kFewestGenerations = 10;  // of the smallest
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

base::Result<double> timeFlatTrack(const study::StudyInputs& inputs, double budget,
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

}  // namespace

base::Result<double> timeTrial(const study::StudyInputs& inputs, double budget,
                               const base::RunControl& control) {
    if (const auto checked = study::checkInputs(inputs); !checked) return checked.error();
    study::StudyInputs timed = inputs;
    study::EvolutionSettings& evolution = timed.settings.evolution;
    // A race's share of trials is its own.
    if (evolution.racingTrials == 0)
        evolution.trialsPerEvaluation = std::min(evolution.trialsPerEvaluation, kTimedTrials);
    const auto random = timeRandomTracks(timed, 0.5 * budget, control);
    if (!random) return random.error();
    const auto flat = timeFlatTrack(timed, 0.5 * budget, control);
    if (!flat) return flat.error();
    return evolution.racingTrials == 0 ? std::max(*random, *flat) : *random;
}

double learningTime(const study::EvolutionSettings& evolution, int generations, double secondsPerTrial) {
    double trials =
        static_cast<double>(evolution.populationSize) * evolution.trialsPerEvaluation * generations;
    if (generations >= evolution.generations)
        trials += static_cast<double>(study::estimatePlanningTrials(evolution));
    return secondsPerTrial * trials;
}

bool costTheSame(const study::Settings& a, const study::Settings& b) {
    study::Settings same = b;
    same.evolution.populationSize = a.evolution.populationSize;
    same.evolution.trialsPerEvaluation = a.evolution.trialsPerEvaluation;
    same.evolution.generations = a.evolution.generations;
    study::takePoseWeights(same.part, a.part);
    same.validation = a.validation;
    same.feeder = a.feeder;
    return same == a;
}

std::optional<study::EvolutionSettings> draftEvolution(const study::EvolutionSettings& full,
                                                       double secondsPerTrial) {
    const double trials = kDraftLearningTime / secondsPerTrial;
    if (!std::isfinite(trials)) return std::nullopt;
    for (const DraftSize& size : kDraftSizes) {
        const int population = std::min(size.population, full.populationSize);
        const int each = std::min(size.trials, full.trialsPerEvaluation);
        study::EvolutionSettings smaller = full;
        smaller.populationSize = population;
        const double left = trials - static_cast<double>(study::estimatePlanningTrials(smaller));
        const double generations = std::floor(left / (static_cast<double>(population) * each));
        const bool last = &size == &kDraftSizes.back();
        const int enough = std::min(last ? kFewestGenerations : kEnoughGenerations, full.generations);
        if (generations < enough) continue;
        study::EvolutionSettings draft = full;
        draft.populationSize = population;
        draft.trialsPerEvaluation = each;
        draft.racingTrials = std::min(draft.racingTrials, each);
        draft.tournamentSize = std::min(draft.tournamentSize, population);
        draft.generations = static_cast<int>(std::min<double>(generations, full.generations));
        return draft;
    }
    return std::nullopt;
}

study::EvolutionSettings fullEvolution(study::EvolutionSettings evolution) {
    const study::EvolutionSettings table;
    evolution.populationSize = table.populationSize;
    evolution.trialsPerEvaluation = table.trialsPerEvaluation;
    evolution.generations = table.generations;
    return evolution;
}

}  // namespace trapwright::workflow
