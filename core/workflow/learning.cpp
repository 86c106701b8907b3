#include "core/workflow/learning.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/study/selection.h"

namespace trapwright::workflow {

Result<LearningReport> learn(store::StudyFile& file, const study::StudyInputs& given,
                             const trial::EngineRegistry& engines, const LearnEvents& events,
                             const study::LearningControl& control) {
    const auto last = file.loadLearningState();
    if (!last) return Failure{FailureKind::reading, last.error().message};
    auto known = file.loadKnownTracks();
    if (!known) return Failure{FailureKind::reading, known.error().message};
    if (std::string problem = study::findKnownProblem(given.settings, *known); !*last && !problem.empty())
        return Failure{FailureKind::settings, std::move(problem)};
    study::StudyInputs inputs = given;
    inputs.known = std::move(*known);
    const auto started = WinnerChecks::start(file, inputs, engines, control.checks);
    if (!started) return started.error();
    WinnerChecks* const checks = started->get();

    const auto begin = std::chrono::steady_clock::now();
    const std::int64_t doneBefore = control.run.done();
    FailureKind kind = FailureKind::simulation;
    study::LearningEvents watch;
    watch.planned = events.planned;
    watch.save = [&](study::GenerationRecord& record) -> base::Status {
        kind = FailureKind::saving;
        if (auto saved = file.saveGeneration(record); !saved) return saved;
        record.made = {};
        if (events.saved) events.saved(record);
        if (checks != nullptr) {
            checks->add(record);
            if (auto saved = checks->save(events.checked); !saved) return saved;
        }
        kind = FailureKind::simulation;
        return base::success();
    };
    const auto end = study::evolve(inputs, *last, watch, control);
    if (!end) {
        if (kind == FailureKind::saving) return describeSaving(end.error());
        if (end.error().kind == base::ErrorKind::damaged) {
            return Failure{FailureKind::reading, "The study " + file.path().string() +
                                                     " is damaged: learning cannot go on after its last "
                                                     "generation. " +
                                                     end.error().message + " Restore it from a copy."};
        }
        if (end.error().kind == base::ErrorKind::unattainable)
            return Failure{FailureKind::settings, end.error().message};
        return Failure{kind, end.error().message};
    }

    LearningReport report;
    report.end = *end;
    if (checks != nullptr) {
        auto left = checks->stop(events.checked);
        if (!left) return describeSaving(left.error());
        report.unchecked = std::move(*left);
    }
    report.trials = control.run.done() - doneBefore;
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return report;
}

base::Result<study::KnownTracks> collectTracks(const store::StudyFile& from) {
    const auto winners = from.loadWinners();
    if (!winners) return winners.error();
    if (winners->empty())
        return base::Error{"The study " + from.path().string() +
                           " has learned no tracks yet. Choose a study that has."};
    study::KnownTracks known{from.path().filename().string(), {}};
    const auto add = [&](const study::IndividualRecord& record) {
        const bool isKnown = std::ranges::any_of(
            known.tracks, [&](const search::Proposal& track) { return track.design == record.design; });
        if (!isKnown) known.tracks.push_back({record.design, record.traits});
    };
    const auto chosen = from.loadChosenWinner();
    if (!chosen) return chosen.error();
    if (*chosen) {
        const auto track = from.loadIndividual(**chosen);
        if (!track) return track.error();
        add(*track);
    }
    const auto selections = from.loadSelections();
    if (!selections) return selections.error();
    if (!selections->empty()) {
        for (const study::SelectionEntry& entry : selections->back().entries) {
            const auto track = from.loadIndividual(entry);
            if (!track) return track.error();
            add(*track);
        }
    }
    // Their relatives, so that there is something to breed from. Those that were mended are nearly one.
    auto last = from.loadGeneration(winners->back().generation);
    while (last && last->mendedFrom)
        last = from.loadGeneration(last->index - 1);
    if (!last) return last.error();
    std::vector<study::Individual> all;
    for (std::size_t i = 0; i < last->individuals.size(); ++i)
        all.push_back({{last->index, static_cast<int>(i)}, std::move(last->individuals[i])});
    const int count = static_cast<int>(all.size());
    for (const study::Individual& individual : study::rankWinners(std::move(all), count))
        add(individual.record);
    return known;
}

}  // namespace trapwright::workflow
