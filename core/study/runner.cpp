#include "core/study/runner.h"

#include <chrono>

#include "core/search/ranking.h"
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

std::vector<search::Judgement> judgementsOf(std::span<const IndividualRecord> individuals) {
    std::vector<search::Judgement> judgements;
    judgements.reserve(individuals.size());
    for (const IndividualRecord& individual : individuals)
        judgements.push_back({individual.fitness.total(), individual.trials});
    return judgements;
}

}  // namespace

GenerationRecord completeGeneration(int index, std::vector<IndividualRecord> individuals,
                                    std::vector<search::NamedNumber> curves) {
    GenerationRecord record;
    record.index = index;
    record.individuals = std::move(individuals);

    const std::vector<std::size_t> top = search::findTop(totalsOf(record.individuals));
    trial::Fitness& mean = record.statistics.topMean;
    double successes = 0.0;
    int simulated = 0;
    for (const std::size_t i : top) {
        const IndividualRecord& individual = record.individuals[i];
        mean.collision += individual.fitness.collision;
        mean.distance += individual.fitness.distance;
        mean.orientation += individual.fitness.orientation;
        if (const auto success = individual.success()) {
            successes += success->share();
            ++simulated;
        }
    }
    const auto count = static_cast<double>(top.size());
    mean = {mean.collision / count, mean.distance / count, mean.orientation / count};
    record.winner = static_cast<int>(top.front());
    record.statistics.best = record.individuals[top.front()].fitness;
    record.statistics.curves = std::move(curves);
    record.statistics.success = record.individuals[top.front()].success();
    if (simulated > 0) record.statistics.topSuccess = successes / simulated;
    return record;
}

LearningState stateAfter(const GenerationRecord& last) {
    return {last.index, last.searchState};
}

base::Result<LearningEnd> evolve(const StudyInputs& inputs, const std::optional<LearningState>& last,
                                 const LearningEvents& events, const LearningControl& control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    const Settings& settings = inputs.settings;
    const std::unique_ptr<search::Search> search = makeSearch(settings);
    if (last) {
        if (const auto loaded = search->load(last->search); !loaded)
            return base::Error{loaded.error().message, base::ErrorKind::damaged};
    }

    for (int index = last ? last->index + 1 : 0;
         index < control.generationsOr(settings.evolution.generations); ++index) {
        if (control.stopRequested()) return LearningEnd::stopped;
        const auto begin = std::chrono::steady_clock::now();
        auto evaluation = evaluateGeneration(inputs, index, search->ask(), events.planned, control.run);
        if (control.run.cancelled()) return LearningEnd::cancelled;
        if (!evaluation) return evaluation.error();

        search->tell(judgementsOf(evaluation->individuals));
        GenerationRecord record =
            completeGeneration(index, std::move(evaluation->individuals), search->report());
        record.made = {makerOf(*inputs.engine), std::move(evaluation->outcomes)};
        record.searchState = search->save();
        record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (const auto saved = events.save(record); !saved) return saved.error();
    }
    return LearningEnd::completed;
}

}  // namespace trapwright::study
