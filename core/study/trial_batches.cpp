#include "core/study/trial_batches.h"

#include <algorithm>
#include <utility>

#include "core/trial/orientations.h"
#include "core/trial/start.h"

namespace trapwright::study {

namespace {

trial::TrialBatch makeBatch(const TrialScene& scene, const trial::StartPolicy& policy, base::StreamKey first,
                            int trials) {
    trial::TrialBatch batch;
    batch.track = scene.track;
    batch.parts = {scene.part};
    batch.drive = scene.simulation->drive;
    batch.contact = scene.simulation->contact;
    batch.termination = scene.simulation->termination;
    batch.gravity = scene.simulation->gravity;
    batch.trials.reserve(static_cast<std::size_t>(trials));
    for (int i = 0; i < trials; ++i, ++first.trial)
        batch.trials.push_back(trial::drawTrial(*scene.track, *scene.part, policy, first));
    return batch;
}

base::StreamKey keyOf(const TrialScene& scene, const IndividualId& individual, int trial,
                      base::Purpose purpose) {
    return {scene.seed, static_cast<std::uint32_t>(individual.generation),
            static_cast<std::uint32_t>(individual.individual), static_cast<std::uint32_t>(trial), purpose};
}

}  // namespace

TrialScene makeScene(const Settings& settings, std::shared_ptr<const part::Part> part,
                     std::shared_ptr<const track::Track> track) {
    return {&settings.simulation,
            std::move(part),
            std::move(track),
            settings.evolution.seed,
            settings.evolution.commonRandomNumbers,
            settings.evolution.learningStuckTime,
            chooseLearningStep(settings)};
}

trial::TrialBatch makeLearningBatch(const TrialScene& scene, const IndividualId& individual, int trials,
                                    int first) {
    const IndividualId stream{individual.generation, scene.commonRandomNumbers ? 0 : individual.individual};
    trial::TrialBatch batch = makeBatch(scene, scene.simulation->start,
                                        keyOf(scene, stream, first, base::Purpose::trialStart), trials);
    double& stuckTime = batch.termination.stuckTime;
    stuckTime = std::min(stuckTime, scene.learningStuckTime.value_or(stuckTime));
    batch.step = scene.learningStep;
    return batch;
}

trial::TrialBatch makeSelectionBatch(const TrialScene& scene, const IndividualId& individual, int trials) {
    return makeBatch(scene, scene.simulation->start,
                     keyOf(scene, individual, 0, base::Purpose::finalSelection), trials);
}

trial::TrialBatch makeValidationBatch(const TrialScene& scene, const IndividualId& individual, int pose,
                                      int trials) {
    trial::StartPolicy policy = scene.simulation->start;
    policy.nearPose = scene.part->stablePoses[static_cast<std::size_t>(pose)].rotation;
    return makeBatch(scene, policy, keyOf(scene, individual, pose * trials, base::Purpose::validation),
                     trials);
}

trial::TrialBatch makeTrackBatch(std::shared_ptr<const track::Track> track,
                                 std::shared_ptr<const part::Part> part, const SimulationSettings& simulation,
                                 std::uint64_t seed, int trials) {
    return makeLearningBatch({&simulation, std::move(part), std::move(track), seed}, {0, 0}, trials);
}

TrialCounts countTrials(std::span<const trial::Outcome> outcomes, const part::SymmetryGroup& symmetry,
                        const std::optional<base::Quaternion>& expected, double tolerance) {
    TrialCounts counts;
    counts.expected =
        expected ? *expected
                 : trial::findModalOrientation(trial::finalOrientations(outcomes), symmetry, tolerance);
    counts.tally = trial::tally(outcomes, counts.expected, symmetry, tolerance);
    for (const trial::Outcome& outcome : outcomes) {
        for (const trial::PartOutcome& part : outcome.parts)
            counts.simulatedTime += part.time;
    }
    return counts;
}

}  // namespace trapwright::study
