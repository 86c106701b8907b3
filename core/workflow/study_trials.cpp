#include "core/workflow/study_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/trial/orientations.h"
#include "core/trial/start.h"

namespace trapwright::workflow {

namespace {

constexpr double kSeenAngle = 0.05 * base::kDegree;  // what the rounded number shows [rad]

using Kept = base::Result<std::optional<store::PackedOutcomes>>;

/// Adds what is stored of one more part of the trials. What is not stored of one of them is not of all.
base::Status addKept(Kept more, std::size_t before, StoredTrials& trials) {
    if (!more) return more.error();
    if (*more && trials.kept.size() == before) trials.kept.push_back(std::move(**more));
    return base::success();
}

base::Result<StoredTrials> findSelectionTrials(const store::StudyFile& file, const study::Settings& settings,
                                               const study::Individual& individual) {
    const auto selections = file.loadSelections();
    if (!selections) return selections.error();
    StoredTrials trials;
    std::pair<int, int> place;
    for (std::size_t number = 0; number < selections->size(); ++number) {
        const study::SelectionRecord& selection = (*selections)[number];
        for (std::size_t rank = 0; rank < selection.entries.size(); ++rank) {
            const study::SelectionEntry& entry = selection.entries[rank];
            if (!isSameIndividual(entry, individual)) continue;
            trials = {entry.trials, selection.engine, entry.goal, settings.validation.tolerance,
                      selection.box};
            place = {static_cast<int>(number), static_cast<int>(rank)};
        }
    }
    if (trials.count == 0) return trials;
    const auto added = addKept(file.loadSelectionOutcomes(place.first, place.second), 0, trials);
    if (!added) return added.error();
    return trials;
}

/// Those of these poses: the trials of a validation are numbered by pose, as many of each.
base::Result<StoredTrials> findValidationTrials(const store::StudyFile& file,
                                                const study::Individual& individual,
                                                std::span<const int> poses) {
    const auto validations = file.loadValidations();
    if (!validations) return validations.error();
    StoredTrials trials;
    int number = 0;
    for (std::size_t place = 0; place < validations->size(); ++place) {
        const study::ValidationRecord& validation = (*validations)[place];
        if (!isSameIndividual(validation, individual)) continue;
        int count = 0;
        for (const study::ValidationRow& row : validation.rows)
            if (std::find(poses.begin(), poses.end(), row.pose) != poses.end()) count += row.tally.trials();
        if (count == 0) continue;
        trials = {count, validation.engine, validation.goal, validation.tolerance, validation.box};
        number = static_cast<int>(place);
    }
    if (trials.count == 0) return trials;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const auto added = addKept(file.loadValidationOutcomes(number, poses[i]), i, trials);
        if (!added) return added.error();
    }
    return trials;
}

base::Result<StoredTrials> findLearningTrials(const store::StudyFile& file, const study::Settings& settings,
                                              const trial::EngineRegistry& engines,
                                              const study::Individual& individual) {
    StoredTrials trials{individual.record.trials,
                        engines.nameFor(settings.simulation.engine, trial::EngineUse::learning), std::nullopt,
                        settings.validation.tolerance};
    const auto added = addKept(file.loadLearningOutcomes(individual), 0, trials);
    if (!added) return added.error();
    return trials;
}

trial::Verdict judgeTrial(const trial::Outcome& outcome, const trial::Goal& goal,
                          const part::SymmetryGroup& symmetry, double tolerance) {
    if (outcome.parts.size() == 1) return trial::judge(outcome.parts.front(), goal, symmetry, tolerance);
    double end = 0.0;
    trial::Verdict worst = trial::Verdict::success;
    for (const trial::PartOutcome& part : outcome.parts) {
        end = std::max(end, part.time);
        if (part.ending == trial::Ending::timedOut) continue;  // still on its way
        worst = std::max(worst, trial::judge(part, goal, symmetry, tolerance));
    }
    const bool jammed =
        std::ranges::any_of(outcome.stops, [end](const trial::Stop& stop) { return stop.to >= end; });
    return jammed ? trial::Verdict::stuck : worst;
}

std::string describeEnd(const trial::PartOutcome& outcome) {
    return fmt::format("{} after {:.3f} s at {:.2f} mm", trial::endingName(outcome.ending), outcome.time,
                       outcome.farthest.position.x() / base::kMillimetre);
}

}  // namespace

base::Result<StoredTrials> findStoredTrials(const store::StudyFile& file, const study::Settings& settings,
                                            const trial::EngineRegistry& engines,
                                            const TrialsRequest& request) {
    if (request.robustness)
        return StoredTrials{request.robustness->trials.count, request.robustness->engine,
                            request.robustness->goal, settings.validation.tolerance};
    if (request.stream)
        return StoredTrials{request.stream->settings.streams, request.stream->engine, request.stream->goal,
                            settings.validation.tolerance};
    auto trials = request.kind == TrialKind::selection ? findSelectionTrials(file, settings, request.winner)
                  : request.kind == TrialKind::validation
                      ? findValidationTrials(file, request.winner, request.poses)
                      : findLearningTrials(file, settings, engines, request.winner);
    // Of another engine there are none.
    if (trials && !request.engine.empty() && request.engine != trials->engine) trials->kept.clear();
    return trials;
}

base::Result<trial::TrialBatch> makeTrials(const study::Settings& settings,
                                           const std::shared_ptr<const part::Part>& part,
                                           const TrialsRequest& request, const StoredTrials& stored) {
    const study::Individual& individual = request.winner;
    auto track = study::decodeTrack(settings.track, individual.record.design);
    if (!track) return track.error();
    study::Settings own = settings;
    if (request.robustness) {
        own.box = request.robustness->box;
        return study::makePlaceBatch(own, part, std::make_shared<const track::Track>(std::move(*track)),
                                     request.robustness->trials);
    }
    const auto judgeIn = [&own](const std::optional<trial::OperatingBox>& box) {
        own.validation.conditions = box ? study::TrialConditions::varied : study::TrialConditions::nominal;
        own.box = box.value_or(own.box);
    };
    if (request.stream) {
        own.stream = request.stream->settings;
        judgeIn(request.stream->box);
        return study::makeStreamBatch(own, part, std::make_shared<const track::Track>(std::move(*track)),
                                      individual, own.stream.partsPerMinute);
    }
    if (request.kind != TrialKind::learning && stored.count > 0) judgeIn(stored.box);
    const study::TrialScene scene =
        study::makeScene(own, part, std::make_shared<const track::Track>(std::move(*track)));
    const int count = request.count > 0 ? request.count : stored.count;
    if (request.kind == TrialKind::selection) return study::makeSelectionBatch(scene, individual, count);
    if (request.kind == TrialKind::validation) {
        // Which stream a trial has depends on how many there were of each pose.
        assert(!request.poses.empty());
        for (const int pose : request.poses) {
            if (pose >= 0 && static_cast<std::size_t>(pose) < scene.part->stablePoses.size()) continue;
            return base::Error{"The study has trials of stable pose " + std::to_string(pose + 1) +
                               ", but its part has " + std::to_string(scene.part->stablePoses.size()) +
                               ". It was changed outside of Trapwright, or made by another version. "
                               "Validate the track again."};
        }
        const int poses = static_cast<int>(request.poses.size());
        const int ofEachPose = stored.count > 0 ? stored.count / poses : count;
        trial::TrialBatch batch =
            study::makeValidationBatch(scene, individual, request.poses.front(), ofEachPose);
        for (auto pose = request.poses.begin() + 1; pose != request.poses.end(); ++pose) {
            const trial::TrialBatch more = study::makeValidationBatch(scene, individual, *pose, ofEachPose);
            batch.trials.insert(batch.trials.end(), more.trials.begin(), more.trials.end());
        }
        batch.trials.resize(std::min(static_cast<std::size_t>(count), batch.trials.size()));
        return batch;
    }
    return study::makeLearningBatch(scene, individual, count);
}

base::Result<std::optional<trial::MadeOutcomes>> unpackTrials(const StoredTrials& stored,
                                                              const trial::TrialBatch& batch) {
    std::optional<trial::MadeOutcomes> made;
    if (stored.kept.empty() || static_cast<std::size_t>(stored.count) < batch.trials.size()) return made;
    made.emplace();
    made->maker = stored.kept.front().maker;
    for (const store::PackedOutcomes& kept : stored.kept) {
        const auto some = store::unpack(kept);
        if (!some) return some.error();
        made->outcomes.insert(made->outcomes.end(), some->begin(), some->end());
    }
    // Not those of every pose are there.
    if (made->outcomes.size() != static_cast<std::size_t>(stored.count)) return {std::nullopt};
    made->outcomes.resize(batch.trials.size());
    for (std::size_t i = 0; i < batch.trials.size(); ++i) {
        const std::vector<trial::PartStart>& starts = batch.trials[i].parts;
        std::vector<trial::PartOutcome>& parts = made->outcomes[i].parts;
        // Those of another number of parts are not of these trials.
        if (parts.size() != starts.size()) return {std::nullopt};
        for (std::size_t k = 0; k < parts.size(); ++k)
            parts[k].initial = trial::startInTrack(*batch.track, starts[k]);
    }
    return made;
}

base::Result<std::vector<study::SlicedCondition>> sliceTrials(const study::Settings& settings,
                                                              const std::shared_ptr<const part::Part>& part,
                                                              const TrialsRequest& request,
                                                              const StoredTrials& stored) {
    const std::vector<study::SlicedCondition> none;
    if (!stored.box || stored.kept.empty()) return none;
    const auto batch = makeTrials(settings, part, request, stored);
    if (!batch) return batch.error();
    const auto made = unpackTrials(stored, *batch);
    if (!made) return made.error();
    if (!*made) return none;
    const JudgedTrials judged = judgeTrials((*made)->outcomes, part->symmetry, stored.goal, stored.tolerance);
    return study::sliceByCondition(settings.simulation, *stored.box, study::listPlaces(*batch),
                                   judged.verdicts);
}

std::optional<OutcomeDifference> findDifference(const trial::Outcome& stored,
                                                const trial::OutcomeMaker& storedBy,
                                                const trial::Outcome& replayed,
                                                const trial::OutcomeMaker& replayedBy) {
    assert(stored.parts.size() == replayed.parts.size());
    for (std::size_t i = 0; i < stored.parts.size(); ++i) {
        if (!trial::endAlike(stored.parts[i], replayed.parts[i]))
            return OutcomeDifference{stored.parts[i], storedBy, replayed.parts[i], replayedBy};
    }
    return std::nullopt;
}

std::string describe(const OutcomeDifference& difference) {
    const std::string stored = describeEnd(difference.stored);
    const std::string replayed = describeEnd(difference.replayed);
    const double angle =
        difference.stored.farthest.rotation.angularDistance(difference.replayed.farthest.rotation);
    std::string text = fmt::format("Stored: {} ({}).\nReplayed here: {}", stored,
                                   trial::describe(difference.storedBy), replayed);
    if (angle >= kSeenAngle) text += fmt::format(", turned by {:.1f}° from it", angle / base::kDegree);
    if (stored == replayed && angle < kSeenAngle) text += ", but for its last digits";
    text += fmt::format(" ({}).\n", trial::describe(difference.replayedBy));
    if (difference.storedBy == difference.replayedBy)
        text +=
            "The same should come of both. Either the study was changed outside of Trapwright, or the "
            "program or a library of this system was. ";
    return text + "Scores and tables go by what is stored.";
}

JudgedTrials judgeTrials(std::span<const trial::Outcome> outcomes, const part::SymmetryGroup& symmetry,
                         const std::optional<trial::Goal>& goal, double tolerance) {
    JudgedTrials judged;
    judged.goal = trial::findGoal(goal, outcomes, symmetry, tolerance);
    judged.verdicts.reserve(outcomes.size());
    for (const trial::Outcome& outcome : outcomes)
        judged.verdicts.push_back(judgeTrial(outcome, judged.goal, symmetry, tolerance));
    return judged;
}

}  // namespace trapwright::workflow
