#include "core/workflow/judging.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/study/planning.h"
#include "core/study/selection.h"
#include "core/study/track_design.h"
#include "core/study/validation.h"

namespace trapwright::workflow {

namespace {

Failure describeFailure(const base::RunControl& control, const base::Error& error) {
    if (control.cancelled()) return {FailureKind::cancelled, "Cancelled; nothing of it was kept."};
    return {FailureKind::simulation, error.message};
}

/// `count` tracks of the whole study's Pareto front, from one end to the other. Empty if no track has all its
/// trials.
Result<std::vector<study::Individual>> loadFront(const store::StudyFile& file,
                                                 const study::EvolutionSettings& settings,
                                                 const objectives::ObjectiveList& traded, int count) {
    const auto pairs = file.loadScorePairs(std::string(traded[0]->key), std::string(traded[1]->key));
    if (!pairs) return Failure{FailureKind::reading, pairs.error().message};
    const std::vector<std::size_t> front =
        study::findParetoFront(*pairs, *traded[0], *traded[1], settings.trialsPerEvaluation);
    const std::size_t taken = std::min(front.size(), static_cast<std::size_t>(std::max(1, count)));
    std::vector<study::Individual> tracks;
    for (std::size_t k = 0; k < taken; ++k) {
        const std::size_t place = taken < 2 ? 0 : k * (front.size() - 1) / (taken - 1);
        const study::IndividualId id = (*pairs)[front[place]];
        auto record = file.loadIndividual(id);
        if (!record) return Failure{FailureKind::reading, record.error().message};
        tracks.push_back({id, std::move(*record)});
    }
    return tracks;
}

}  // namespace

Result<std::vector<study::Individual>> findCandidates(const store::StudyFile& file,
                                                      const study::StudyInputs& inputs) {
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{FailureKind::settings, checked.error().message};
    auto winners = file.loadWinners();
    if (!winners) return Failure{FailureKind::reading, winners.error().message};
    if (winners->empty()) {
        return Failure{FailureKind::reading,
                       "The study " + file.path().string() +
                           " has no generations to select from. Learn some first with evolve."};
    }
    const int count = inputs.settings.validation.selectionWinners;
    if (const auto traded = study::tradedObjectives(inputs.settings.evolution); !traded.empty()) {
        auto front = loadFront(file, inputs.settings.evolution, traded, count);
        if (!front || !front->empty()) return front;
    }
    // What many trials were spent on, whoever won its generation: the plan's best, and what exchanges went on
    // from last.
    const bool exchanges = inputs.settings.evolution.search == search::Method::exchange;
    if (!exchanges && !study::isPlanned(inputs.settings.evolution))
        return study::rankWinners(std::move(*winners), count);
    study::IndividualId first{0, 0};
    for (const study::Individual& winner : *winners) {
        if (exchanges) first.generation = std::max(first.generation, winner.generation);
    }
    auto tried = file.loadIndividual(first);
    if (!tried) return Failure{FailureKind::reading, tried.error().message};
    std::vector<study::Individual> candidates =
        study::rankWinners(std::move(*winners), std::max(1, count - 1));
    const bool isKnown = std::any_of(candidates.begin(), candidates.end(), [&](const auto& candidate) {
        return candidate.record.design == tried->design;
    });
    if (!isKnown && static_cast<int>(candidates.size()) < count)
        candidates.push_back({first, std::move(*tried)});
    return candidates;
}

Result<study::SelectionRecord> selectAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                             std::vector<study::Individual> candidates,
                                             const base::RunControl& control) {
    auto record = study::selectWinners(inputs, std::move(candidates), control);
    if (!record) return describeFailure(control, record.error());
    if (const auto saved = file.saveSelection(*record); !saved) return describeSaving(saved.error());
    record->made = {};
    return std::move(*record);
}

std::int64_t countValidationTrials(const study::StudyInputs& inputs) {
    return static_cast<std::int64_t>(inputs.part->stablePoses.size()) *
           inputs.settings.validation.trialsPerPose;
}

Result<study::ValidationRecord> validateAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                                const study::Individual& individual,
                                                const std::optional<trial::Goal>& expected,
                                                const base::RunControl& control) {
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{FailureKind::settings, checked.error().message};
    auto record = study::validate(inputs, individual, expected, control);
    if (!record) return describeFailure(control, record.error());
    if (const auto saved = file.saveValidation(*record); !saved) return describeSaving(saved.error());
    record->made = {};
    return std::move(*record);
}

Result<study::RobustnessRecord> measureAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                               const study::Individual& individual,
                                               const std::optional<trial::Goal>& goal,
                                               const study::RobustnessPlan& plan,
                                               const base::RunControl& control) {
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{FailureKind::settings, checked.error().message};
    auto track = study::decodeTrack(inputs.settings.track, individual.record.design);
    if (!track) return Failure{FailureKind::settings, track.error().message};
    auto robustness = study::measureRobustness(
        inputs, std::make_shared<const track::Track>(std::move(*track)), goal, plan, control);
    if (!robustness) return describeFailure(control, robustness.error());
    study::RobustnessRecord record{{individual.generation, individual.individual},
                                   inputs.engine->name(),
                                   inputs.settings.box,
                                   std::move(*robustness)};
    if (const auto saved = file.saveRobustness(record); !saved) return describeSaving(saved.error());
    return record;
}

Result<study::StreamsRecord> measureStreamsAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                                   const study::Individual& individual,
                                                   const std::optional<trial::Goal>& goal,
                                                   const std::vector<double>& inflows,
                                                   const base::RunControl& control) {
    auto track = study::decodeTrack(inputs.settings.track, individual.record.design);
    if (!track) return Failure{FailureKind::settings, track.error().message};
    auto streams = study::measureStreams(inputs, std::make_shared<const track::Track>(std::move(*track)),
                                         individual, goal, inflows, control);
    if (!streams) return describeFailure(control, streams.error());
    study::StreamsRecord record{{individual.generation, individual.individual},
                                inputs.engine->name(),
                                study::boxOfJudging(inputs.settings),
                                std::move(*streams)};
    if (const auto saved = file.saveStreams(record); !saved) return describeSaving(saved.error());
    return record;
}

std::int64_t countMendingTrials(const study::Settings& settings, const study::MendingPlan& plan) {
    const std::int64_t compared = 1 + std::min(plan.compared, plan.variants);
    return static_cast<std::int64_t>(plan.variants) * plan.trials +
           compared * (settings.validation.selectionTrials + study::countCornerTrials(settings));
}

Result<MendingReport> mendAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                  const study::Individual& track, const study::MendingPlan& plan,
                                  const std::function<void(const study::GenerationRecord&)>& saved,
                                  const base::RunControl& control) {
    const auto last = file.loadLearningState();
    if (!last) return Failure{FailureKind::reading, last.error().message};
    if (!*last) {
        return Failure{FailureKind::reading, "The study " + file.path().string() +
                                                 " has no generations, and so no track to mend. Learn some "
                                                 "first with evolve."};
    }
    MendingReport report;
    const auto unprintable =
        study::measureUnprintable(inputs.settings.track, track.record.design, plan.limits);
    if (!unprintable) return Failure{FailureKind::settings, unprintable.error().message};
    report.unprintable = *unprintable;
    if (report.unprintable <= 0.0) {
        return Failure{FailureKind::settings,
                       fmt::format("Nothing of this track is thinner than {:g} mm or overhangs by more than "
                                   "{:g} degrees: there is nothing to mend.",
                                   plan.limits.thinnestWall / base::kMillimetre,
                                   plan.limits.steepestOverhang / base::kDegree)};
    }
    auto variants = study::mendVariants(inputs, (*last)->index + 1, track, plan, control);
    if (!variants) return describeFailure(control, variants.error());
    const double least =
        std::ranges::min_element(*variants, {}, &study::MendedDesign::unprintable)->unprintable;
    if (least > 0.0) {
        constexpr double kSquareMillimetre = 1e-6;  // [m^2]
        return Failure{
            FailureKind::notSolid,
            fmt::format(
                "{:.2f} mm2 of this track cannot be printed, and none of {} variants is without: {:.2f} "
                "mm2 are left of the best. Try more variants, another track, or learn with F_P among "
                "evolution.objectives.",
                report.unprintable / kSquareMillimetre, plan.variants, least / kSquareMillimetre)};
    }
    auto generation = study::judgeVariants(inputs, **last, track, *std::move(variants), plan, control);
    if (!generation) return describeFailure(control, generation.error());
    std::vector<study::Individual> printable;
    for (std::size_t i = 0; i < generation->individuals.size(); ++i)
        printable.push_back({{generation->index, static_cast<int>(i)}, generation->individuals[i]});
    std::vector<study::Individual> candidates = study::rankWinners(std::move(printable), plan.compared);
    candidates.push_back(track);
    study::StudyInputs comparing = inputs;
    comparing.settings.validation.selectionWinners = static_cast<int>(candidates.size());
    auto selection = study::selectWinners(comparing, std::move(candidates), control);
    if (!selection) return describeFailure(control, selection.error());

    if (const auto kept = file.saveGeneration(*generation); !kept) return describeSaving(kept.error());
    generation->made = {};
    report.generation = *std::move(generation);
    if (saved) saved(report.generation);
    if (const auto kept = file.saveSelection(*selection); !kept) return describeSaving(kept.error());
    selection->made = {};
    report.selection = *std::move(selection);
    const auto best = std::ranges::find_if(report.selection.entries, [&](const study::SelectionEntry& entry) {
        return entry.generation == report.generation.index;
    });
    report.best = *best;
    if (const auto kept = file.chooseWinner(report.best); !kept) return describeSaving(kept.error());
    return report;
}

}  // namespace trapwright::workflow
