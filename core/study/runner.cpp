#include "core/study/runner.h"

#include <chrono>

#include "core/evolution/population.h"
#include "core/evolution/statistics.h"
#include "core/study/track_design.h"

namespace trapwright::study {

namespace {

std::vector<double> totalsOf(std::span<const IndividualRecord> individuals) {
    std::vector<double> totals;
    totals.reserve(individuals.size());
    for (const IndividualRecord& individual : individuals)
        totals.push_back(individual.fitness.total());
    return totals;
}

std::vector<evolution::Chromosome> childrenOf(const Settings& settings, const GenerationRecord& last) {
    std::vector<evolution::Chromosome> parents;
    parents.reserve(last.individuals.size());
    for (const IndividualRecord& individual : last.individuals)
        parents.push_back(individual.chromosome);
    return evolution::nextGeneration(parents, totalsOf(last.individuals),
                                     generationParameters(settings.evolution), makeSmoothing(settings.track),
                                     settings.evolution.seed, static_cast<std::uint32_t>(last.index + 1));
}

}  // namespace

GenerationRecord completeGeneration(int index, std::vector<IndividualRecord> individuals,
                                    const EvolutionSettings& settings) {
    GenerationRecord record;
    record.index = index;
    record.individuals = std::move(individuals);

    const std::vector<std::size_t> top = evolution::findTop(totalsOf(record.individuals));
    const evolution::TransitionParameters bounds = generationParameters(settings).transition;
    std::vector<evolution::StrategyValues> strategies;
    trial::Fitness& mean = record.statistics.topMean;
    double successes = 0.0;
    int simulated = 0;
    for (const std::size_t i : top) {
        const IndividualRecord& individual = record.individuals[i];
        mean.collision += individual.fitness.collision;
        mean.distance += individual.fitness.distance;
        mean.orientation += individual.fitness.orientation;
        strategies.push_back(
            evolution::limitStrategy(evolution::decodeStrategy(individual.chromosome.strategy), bounds));
        if (const auto success = individual.success()) {
            successes += success->share();
            ++simulated;
        }
    }
    const auto count = static_cast<double>(top.size());
    mean = {mean.collision / count, mean.distance / count, mean.orientation / count};
    record.winner = static_cast<int>(top.front());
    record.statistics.best = record.individuals[top.front()].fitness;
    record.statistics.topStrategy = evolution::calcGeometricMean(strategies);
    record.statistics.success = record.individuals[top.front()].success();
    if (simulated > 0) record.statistics.topSuccess = successes / simulated;
    return record;
}

base::Result<LearningEnd> evolve(const StudyInputs& inputs, std::optional<GenerationRecord> last,
                                 const LearningEvents& events, const LearningControl& control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    const Settings& settings = inputs.settings;
    if (last) {
        for (const IndividualRecord& individual : last->individuals) {
            if (const auto checked = checkGenes(settings.track, individual.chromosome); !checked)
                return checked.error();
        }
    }

    for (int index = last ? last->index + 1 : 0;
         index < control.generationsOr(settings.evolution.generations); ++index) {
        if (control.stopRequested()) return LearningEnd::stopped;
        const auto begin = std::chrono::steady_clock::now();
        const std::vector<evolution::Chromosome> population =
            last ? childrenOf(settings, *last)
                 : evolution::createPopulation(chromosomeLayout(settings.track),
                                               settings.evolution.populationSize, settings.evolution.seed);
        auto individuals = evaluateGeneration(inputs, index, population, events.planned, control.run);
        if (control.run.cancelled()) return LearningEnd::cancelled;
        if (!individuals) return individuals.error();

        last = completeGeneration(index, std::move(individuals).value(), settings.evolution);
        last->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (const auto saved = events.save(*last); !saved) return saved.error();
    }
    return LearningEnd::completed;
}

}  // namespace trapwright::study
