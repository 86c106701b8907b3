#include "core/study/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/search/ranking.h"
#include "core/study/planning.h"
#include "core/study/track_design.h"

namespace trapwright::study {

namespace {

std::vector<double> totalsOf(std::span<const IndividualRecord> individuals) {
    std::vector<double> totals;
    totals.reserve(individuals.size());
    for (const IndividualRecord& individual : individuals)
        totals.push_back(individual.fitness.total);
    return totals;
}

/// A place among all has no standard error.
std::vector<search::Judgement> judgementsOf(const EvolutionSettings& settings,
                                            std::span<const IndividualRecord> individuals) {
    const objectives::ObjectiveList summed = summedObjectives(settings);
    const bool isSum = tradedObjectives(settings).empty();
    std::vector<objectives::Fitness> fitnesses;
    fitnesses.reserve(individuals.size());
    for (const IndividualRecord& individual : individuals)
        fitnesses.push_back(individual.fitness);
    const std::vector<double> scores = rankingScores(settings, fitnesses);
    std::vector<search::Judgement> judgements;
    judgements.reserve(individuals.size());
    for (std::size_t i = 0; i < individuals.size(); ++i) {
        const objectives::Fitness& fitness = individuals[i].fitness;
        search::Judgement judgement{scores[i], individuals[i].trials,
                                    isSum ? objectives::calcTotalError(fitness, summed) : 0.0};
        for (const objectives::Objective* objective : summed) {
            const double value = objectives::findScore(fitness, objective->key)->value;
            judgement.objectives.push_back(
                {std::string(objective->key), objective->moreIsBetter ? value : -value});
        }
        judgements.push_back(std::move(judgement));
    }
    return judgements;
}

/// The mean of each score; the total is their sum.
objectives::Fitness calcMean(std::span<const IndividualRecord> individuals,
                             std::span<const std::size_t> chosen, const objectives::ObjectiveList& summed) {
    objectives::Fitness mean;
    for (const objectives::Score& score : individuals[chosen.front()].fitness.scores)
        mean.scores.push_back({score.key});
    for (const std::size_t i : chosen) {
        for (objectives::Score& score : mean.scores) {
            const objectives::Score* own = objectives::findScore(individuals[i].fitness, score.key);
            if (own != nullptr) score.value += own->value;
        }
    }
    for (objectives::Score& score : mean.scores)
        score.value /= static_cast<double>(chosen.size());
    mean.total = objectives::calcTotal(mean.scores, summed);
    return mean;
}

}  // namespace

GenerationRecord completeGeneration(int index, std::vector<IndividualRecord> individuals,
                                    std::vector<search::NamedNumber> curves,
                                    const objectives::ObjectiveList& summed) {
    GenerationRecord record;
    record.index = index;
    record.individuals = std::move(individuals);

    const std::vector<std::size_t> top = search::findTop(totalsOf(record.individuals));
    double successes = 0.0;
    int simulated = 0;
    for (const std::size_t i : top) {
        const IndividualRecord& individual = record.individuals[i];
        if (const auto success = individual.success()) {
            successes += success->share();
            ++simulated;
        }
    }
    record.statistics.topMean = calcMean(record.individuals, top, summed);
    record.winner = static_cast<int>(top.front());
    record.statistics.best = record.individuals[top.front()].fitness;
    record.statistics.curves = std::move(curves);
    record.statistics.success = record.individuals[top.front()].success();
    if (simulated > 0) record.statistics.topSuccess = successes / simulated;
    return record;
}

std::string findKnownProblem(const Settings& settings, const KnownTracks& known) {
    if (settings.evolution.firstGeneration != search::ga::FirstGeneration::known) return {};
    if (known.tracks.empty())
        return "evolution.firstGeneration is known, but this study has no tracks of another one to begin "
               "with. "
               "Choose graded, or have a new study made that begins with tracks (evolve --begin-with; Change "
               "in a new study).";
    const std::size_t wanted = designSpace(settings.track).dimensions.size();
    const std::size_t had = known.tracks.front().design.size();
    if (wanted == had) return {};
    return fmt::format(
        "evolution.firstGeneration is known, but the tracks of {} are made of {} numbers, and these settings "
        "of "
        "track need {}. Choose graded, or the traps, track.crossSections, track.pointsPerSection and "
        "track.encoding of that study.",
        known.study, had, wanted);
}

std::size_t countKnown(const EvolutionSettings& settings) {
    return static_cast<std::size_t>(std::max(settings.populationSize / 2, 1));
}

LearningState stateAfter(const GenerationRecord& last) {
    return {last.index, last.searchState};
}

base::Result<LearningEnd> evolve(const StudyInputs& inputs, const std::optional<LearningState>& last,
                                 const LearningEvents& events, const LearningControl& control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    const Settings& settings = inputs.settings;
    const std::unique_ptr<search::Search> search = makeSearch(settings);
    const objectives::ObjectiveList summed = summedObjectives(settings.evolution);
    if (last) {
        if (const auto loaded = search->load(last->search); !loaded)
            return base::Error{loaded.error().message, base::ErrorKind::damaged};
    }

    if (!last && isPlanned(settings.evolution)) {
        auto designs = planDesigns(inputs, countPlanned(settings.evolution), events.planned, control);
        if (control.run.cancelled()) return LearningEnd::cancelled;
        if (control.stopRequested()) return LearningEnd::stopped;
        if (!designs) return designs.error();
        std::vector<search::Proposal> proposals;
        for (search::Design& design : *designs)
            proposals.push_back({std::move(design)});
        search->begin(proposals);
    }
    if (!last && settings.evolution.firstGeneration == search::ga::FirstGeneration::known) {
        if (std::string problem = findKnownProblem(settings, inputs.known); !problem.empty())
            return base::Error{"The settings cannot be used:\n" + problem};
        const std::vector<search::Proposal>& tracks = inputs.known.tracks;
        search->begin(std::span(tracks).first(std::min(tracks.size(), countKnown(settings.evolution))));
    }
    for (int index = last ? last->index + 1 : 0;
         index < control.generationsOr(settings.evolution.generations); ++index) {
        if (control.stopRequested()) return LearningEnd::stopped;
        const auto begin = std::chrono::steady_clock::now();
        auto evaluation = evaluateGeneration(inputs, index, search->ask(), events.planned, control.run);
        if (control.run.cancelled()) return LearningEnd::cancelled;
        if (!evaluation) return evaluation.error();

        search->tell(judgementsOf(settings.evolution, evaluation->individuals));
        GenerationRecord record =
            completeGeneration(index, std::move(evaluation->individuals), search->report(), summed);
        record.made = {makerOf(*inputs.engine), std::move(evaluation->outcomes)};
        record.searchState = search->save();
        record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (const auto saved = events.save(record); !saved) return saved.error();
    }
    return LearningEnd::completed;
}

}  // namespace trapwright::study
