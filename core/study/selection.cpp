#include "core/study/selection.h"

#include <algorithm>
#include <tuple>

#include "core/study/operating_box.h"
#include "core/study/stream.h"
#include "core/study/target.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/study/validation.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

namespace {

/// The share that tells which is better: where corners of the box were tried, what holds in them counts as
/// much as what holds on average, which hardly shows them.
double calcWorth(const SelectionEntry& entry) {
    const double success = static_cast<double>(entry.oriented) / entry.trials;
    return entry.corners.trials > 0 ? 0.5 * (success + entry.corners.share()) : success;
}

bool isBetter(const SelectionEntry& a, const SelectionEntry& b, bool byFitness) {
    const auto rank = [&](const SelectionEntry& entry) {
        return std::make_tuple(byFitness ? 0.0 : -calcWorth(entry), -entry.fitness.total, entry.generation,
                               entry.individual);
    };
    return rank(a) < rank(b);
}

/// Whether trials of learning were in corners of the operating box, which are harder than others.
bool isLearnedInCorners(const IndividualRecord& record) {
    const objectives::Score* corners = objectives::findScore(record.fitness, objectives::kCorners);
    return corners != nullptr && corners->value > 0.0;
}

}  // namespace

int countCornerTrials(const Settings& settings) {
    if (settings.validation.conditions == TrialConditions::nominal) return 0;
    return hasRoom(settings.simulation, settings.box) ? settings.validation.selectionCornerTrials : 0;
}

std::vector<Individual> rankWinners(std::vector<Individual> winners, int count) {
    std::stable_sort(winners.begin(), winners.end(), [](const Individual& a, const Individual& b) {
        return std::make_tuple(-a.record.fitness.total, -a.generation, a.individual) <
               std::make_tuple(-b.record.fitness.total, -b.generation, b.individual);
    });
    std::vector<Individual> ranked;
    for (Individual& winner : winners) {
        if (ranked.size() == static_cast<std::size_t>(count)) break;
        const bool known = std::any_of(ranked.begin(), ranked.end(), [&](const Individual& better) {
            return better.record.design == winner.record.design;
        });
        if (!known) ranked.push_back(std::move(winner));
    }
    return ranked;
}

bool forgivesFalls(const EvolutionSettings& settings) {
    const objectives::ObjectiveList summed = summedObjectives(settings);
    return objectives::contains(summed, objectives::kSorting) ||
           objectives::contains(summed, objectives::kPurity);
}

const Individual* findBestWinner(std::span<const Individual> winners, bool fallsAreForgiven) {
    const auto worth = [&](const Individual& winner) {
        const auto success = fallsAreForgiven ? std::nullopt : winner.record.success();
        return std::make_tuple(isLearnedInCorners(winner.record), success ? success->share() : -1.0,
                               winner.record.fitness.total);
    };
    // The last of the greatest ones.
    const Individual* best = nullptr;
    for (const Individual& winner : winners) {
        if (best == nullptr || worth(winner) >= worth(*best)) best = &winner;
    }
    return best;
}

base::Result<SelectionRecord> selectWinners(const StudyInputs& inputs, std::vector<Individual> winners,
                                            base::RunControl control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    if (winners.empty())
        return base::Error{"There are no winners to select from. Learn some generations first."};
    const Settings& settings = inputs.settings;

    const std::vector<Individual> ranked =
        rankWinners(std::move(winners), settings.validation.selectionWinners);
    const Specimens specimens = makeSpecimens(settings, inputs.part);
    std::vector<trial::TrialBatch> batches;
    for (const Individual& winner : ranked) {
        auto track = decodeTrack(settings.track, winner.record.design);
        if (!track) return track.error();
        const TrialScene scene =
            makeScene(settings, specimens, std::make_shared<const track::Track>(std::move(track).value()));
        batches.push_back(makeSelectionBatch(scene, winner, settings.validation.selectionTrials));
    }
    const int cornerTrials = countCornerTrials(settings);
    for (std::size_t i = 0; cornerTrials > 0 && i < ranked.size(); ++i)
        batches.push_back(
            makeCornerBatch(makeScene(settings, specimens, batches[i].track), ranked[i], cornerTrials));
    const bool hasStreams = countStreamed(settings.evolution) > 0;
    const std::size_t firstStream = batches.size();
    for (std::size_t i = 0; hasStreams && i < ranked.size(); ++i)
        batches.push_back(makeStreamBatch(settings, inputs.part, batches[i].track, ranked[i],
                                          settings.stream.partsPerMinute));
    const auto outcomes = runTrials(*inputs.engine, batches, std::move(control));
    if (!outcomes) return outcomes.error();

    const objectives::ObjectiveList summed = summedObjectives(settings.evolution);
    const std::optional<trial::Goal> wanted = findWanted(settings, *inputs.part);
    SelectionRecord record{inputs.engine->name(), {}};
    record.box = boxOfJudging(settings);
    for (std::size_t i = 0; i < ranked.size(); ++i) {
        const std::vector<trial::Outcome>& own = (*outcomes)[i];
        SelectionEntry entry;
        entry.generation = ranked[i].generation;
        entry.individual = ranked[i].individual;
        entry.trials = static_cast<int>(own.size());
        entry.finished = static_cast<int>(trial::finalOrientations(own).size());
        entry.goal = trial::findGoal(wanted, own, inputs.part->symmetry, settings.validation.tolerance);
        const auto countSuccess = [&](std::span<const trial::Outcome> trials) {
            return trial::tally(trials, entry.goal, inputs.part->symmetry, settings.validation.tolerance)
                .success;
        };
        entry.oriented = countSuccess(own);
        if (cornerTrials > 0) entry.corners = {countSuccess((*outcomes)[ranked.size() + i]), cornerTrials};
        const std::vector<trial::BoxPlace> places = listPlaces(batches[i]);
        objectives::Evaluation evaluation =
            makeEvaluation(inputs, *batches[i].track, ranked[i].record.overlaps, own, places);
        evaluation.oriented = entry.oriented;
        if (cornerTrials > 0) evaluation.corners = entry.corners;
        if (hasStreams)
            evaluation.streams = countThroughput(settings.stream, entry.goal, inputs.part->symmetry,
                                                 settings.validation.tolerance, batches[firstStream + i],
                                                 (*outcomes)[firstStream + i]);
        entry.fitness = objectives::measureAll(evaluation, summed);
        record.entries.push_back(std::move(entry));
    }
    std::sort(record.entries.begin(), record.entries.end(),
              [byFitness = hasStreams || forgivesFalls(settings.evolution)](
                  const SelectionEntry& a, const SelectionEntry& b) { return isBetter(a, b, byFitness); });
    record.made.maker = makerOf(*inputs.engine);
    for (const SelectionEntry& entry : record.entries) {
        const auto place = std::find_if(ranked.begin(), ranked.end(), [&](const Individual& winner) {
            return isSameIndividual(winner, entry);
        });
        const std::vector<trial::Outcome>& own =
            (*outcomes)[static_cast<std::size_t>(place - ranked.begin())];
        record.made.outcomes.insert(record.made.outcomes.end(), own.begin(), own.end());
    }
    return record;
}

stats::Interval TrackSuccess::calcInterval() const {
    return ofArriving ? stats::estimateCorrect(strata).interval
                      : stats::estimateWeighted(stats::countRight(strata)).interval;
}

std::optional<TrackSuccess> findSuccess(std::span<const SelectionRecord> selections,
                                        std::span<const ValidationRecord> validations,
                                        const Individual& individual, std::span<const part::PoseGroup> groups,
                                        bool fallsAreForgiven) {
    using Source = TrackSuccess::Source;
    const auto isMeant = [&](const IndividualId& of) { return isSameIndividual(of, individual); };
    const auto weigh = [&](Source source, std::vector<stats::ArrivalStratum> strata,
                           const stats::Count& count, int finished) -> std::optional<TrackSuccess> {
        const std::optional<double> right = stats::calcWeightedRate(stats::countRight(strata));
        const std::optional<double> arriving = stats::calcWeightedRate(stats::countArrived(strata));
        if (!right || !arriving) return std::nullopt;
        const std::optional<double> correct =
            fallsAreForgiven ? stats::estimateCorrect(strata).rate : std::nullopt;
        return TrackSuccess{source,   correct.has_value(), correct.value_or(*right), *arriving, count,
                            finished, std::move(strata)};
    };
    const auto allAlike = [&](Source source, const stats::Count& count, int finished) {
        return weigh(source, {{1.0, count.trials, finished, count.successes}}, count, finished);
    };
    const auto validation = std::find_if(validations.rbegin(), validations.rend(), isMeant);
    if (validation != validations.rend()) {
        const ValidationRow total = calcTotal(*validation);
        const stats::Count count{total.tally.success, total.tally.trials()};
        const int finished = total.tally.finished();
        if (auto weighted = weigh(Source::validation, listStrata(*validation, groups), count, finished))
            return weighted;
        if (count.trials > 0) return allAlike(Source::validation, count, finished);
    }
    // The newest that has simulated it.
    const SelectionEntry* newest = nullptr;
    for (const SelectionRecord& selection : selections) {
        const auto entry = std::find_if(selection.entries.begin(), selection.entries.end(), isMeant);
        if (entry != selection.entries.end() && entry->trials > 0) newest = &*entry;
    }
    if (newest != nullptr)
        return allAlike(Source::selection, {newest->oriented, newest->trials}, newest->finished);
    if (const auto learned = individual.record.success())
        return allAlike(Source::learning, *learned, individual.record.finished);
    return std::nullopt;
}

}  // namespace trapwright::study
