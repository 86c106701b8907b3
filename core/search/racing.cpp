#include "core/search/racing.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/search/ranking.h"

namespace trapwright::search {

std::vector<RacingStage> makeRacingStages(std::size_t population, int first, int all, double share) {
    const int everybody = static_cast<int>(population);
    if (first <= 0 || first >= all) return {{all, everybody}};
    std::vector<RacingStage> stages;
    for (std::int64_t trials = first; 2 * trials <= all; trials *= 2)
        stages.push_back({static_cast<int>(trials), everybody});
    if (stages.empty()) stages.push_back({first, everybody});
    stages.push_back({all, everybody});
    const auto last = static_cast<double>(stages.size() - 1);
    for (std::size_t k = 1; k < stages.size(); ++k)
        stages[k].places = countShare(population, std::pow(share, static_cast<double>(k) / last));
    return stages;
}

std::vector<RacingStep> findNextRound(std::span<const double> fitnesses, std::span<const int> trials,
                                      std::span<const RacingStage> stages) {
    assert(fitnesses.size() == trials.size());
    std::vector<RacingStep> round;
    const std::vector<std::size_t> ranking = rankByFitness(fitnesses);
    for (std::size_t place = 0; place < ranking.size(); ++place) {
        const std::size_t individual = ranking[place];
        const auto next = std::find_if(stages.begin(), stages.end(), [&](const RacingStage& stage) {
            return stage.trials > trials[individual];
        });
        if (next != stages.end() && place < static_cast<std::size_t>(next->places))
            round.push_back({individual, next->trials});
    }
    std::sort(round.begin(), round.end(),
              [](const RacingStep& a, const RacingStep& b) { return a.individual < b.individual; });
    return round;
}

std::int64_t countRacingTrials(std::span<const int> trials, int running,
                               std::span<const RacingStage> stages) {
    const auto idle = static_cast<std::int64_t>(trials.size()) - running;
    std::int64_t total = 0;
    int before = 0;
    for (const RacingStage& stage : stages) {
        const auto reached =
            std::count_if(trials.begin(), trials.end(), [&](int own) { return own >= stage.trials; });
        const std::int64_t runners = std::max<std::int64_t>(std::min(stage.places, running), reached - idle);
        total += runners * (stage.trials - before);
        before = stage.trials;
    }
    return total;
}

std::int64_t countRacingTrials(std::span<const RacingStage> stages) {
    std::int64_t total = 0;
    int before = 0;
    for (const RacingStage& stage : stages) {
        total += static_cast<std::int64_t>(stage.places) * (stage.trials - before);
        before = stage.trials;
    }
    return total;
}

}  // namespace trapwright::search
