#include "core/workflow/study_trials.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/trial/orientations.h"

namespace trapwright::workflow {

namespace {

base::Result<StoredTrials> findSelectionTrials(const store::StudyFile& file, const study::Settings& settings,
                                               const study::Individual& individual) {
    const auto selections = file.loadSelections();
    if (!selections) return selections.error();
    StoredTrials trials;
    for (const study::SelectionRecord& selection : *selections)
        for (const study::SelectionEntry& entry : selection.entries)
            if (entry.generation == individual.generation && entry.individual == individual.individual)
                trials = {entry.trials, selection.engine, entry.modalOrientation,
                          settings.validation.tolerance};
    return trials;
}

/// Those of these poses: the trials of a validation are numbered by pose, as many of each.
base::Result<StoredTrials> findValidationTrials(const store::StudyFile& file,
                                                const study::Individual& individual,
                                                std::span<const int> poses) {
    const auto validations = file.loadValidations();
    if (!validations) return validations.error();
    StoredTrials trials;
    for (const study::ValidationRecord& validation : *validations) {
        if (validation.generation != individual.generation || validation.individual != individual.individual)
            continue;
        int count = 0;
        for (const study::ValidationRow& row : validation.rows)
            if (std::find(poses.begin(), poses.end(), row.pose) != poses.end()) count += row.trials;
        if (count > 0)
            trials = {count, validation.engine, validation.expectedOrientation, validation.tolerance};
    }
    return trials;
}

}  // namespace

base::Result<StoredTrials> findStoredTrials(const store::StudyFile& file, const study::Settings& settings,
                                            const trial::EngineRegistry& engines,
                                            const TrialsRequest& request) {
    if (request.kind == TrialKind::selection) return findSelectionTrials(file, settings, request.winner);
    if (request.kind == TrialKind::validation)
        return findValidationTrials(file, request.winner, request.poses);
    return StoredTrials{request.winner.record.trials,
                        engines.nameFor(settings.simulation.engine, trial::EngineUse::learning), std::nullopt,
                        settings.validation.tolerance};
}

base::Result<trial::TrialBatch> makeTrials(const study::Settings& settings,
                                           std::shared_ptr<const part::Part> part,
                                           const TrialsRequest& request, const StoredTrials& stored) {
    const study::Individual& individual = request.winner;
    auto track = study::decodeTrack(settings.track, individual.record.design);
    if (!track) return track.error();
    const study::TrialScene scene =
        study::makeScene(settings, std::move(part), std::make_shared<const track::Track>(std::move(*track)));
    const int count = request.count > 0 ? request.count : stored.count;
    if (request.kind == TrialKind::selection)
        return study::makeSelectionBatch(scene, individual.generation, individual.individual, count);
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
        trial::TrialBatch batch = study::makeValidationBatch(
            scene, individual.generation, individual.individual, request.poses.front(), ofEachPose);
        for (auto pose = request.poses.begin() + 1; pose != request.poses.end(); ++pose) {
            const trial::TrialBatch more = study::makeValidationBatch(
                scene, individual.generation, individual.individual, *pose, ofEachPose);
            batch.trials.insert(batch.trials.end(), more.trials.begin(), more.trials.end());
        }
        batch.trials.resize(std::min(static_cast<std::size_t>(count), batch.trials.size()));
        return batch;
    }
    return study::makeLearningBatch(scene, individual.generation, individual.individual, count);
}

JudgedTrials judgeTrials(std::span<const trial::Outcome> outcomes, const part::SymmetryGroup& symmetry,
                         const std::optional<base::Quaternion>& expected, double tolerance) {
    JudgedTrials judged;
    judged.expected =
        expected ? *expected
                 : trial::findModalOrientation(trial::finalOrientations(outcomes), symmetry, tolerance);
    judged.verdicts.reserve(outcomes.size());
    for (const trial::Outcome& outcome : outcomes) {
        if (outcome.ending == trial::Ending::finished) {
            judged.verdicts.push_back(trial::isOriented(outcome, judged.expected, symmetry, tolerance)
                                          ? TrialVerdict::success
                                          : TrialVerdict::wrongOrientation);
        } else {
            judged.verdicts.push_back(outcome.ending == trial::Ending::fellOff ? TrialVerdict::fellOff
                                                                               : TrialVerdict::stuck);
        }
    }
    return judged;
}

}  // namespace trapwright::workflow
