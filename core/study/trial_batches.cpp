#include "core/study/trial_batches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

#include "core/trial/goal.h"
#include "core/trial/orientations.h"
#include "core/trial/start.h"

namespace trapwright::study {

namespace {

trial::TrialBatch makeBatch(const TrialScene& scene, const trial::StartPolicy& policy, base::StreamKey first,
                            int trials, TrialConditions conditions, double cornerShare = 0.0) {
    trial::TrialBatch batch;
    batch.track = scene.track;
    batch.parts = {scene.part};
    batch.drive = scene.simulation->drive;
    batch.contact = scene.simulation->contact;
    batch.termination = terminationOn(*scene.simulation, *scene.track);
    batch.gravity = scene.simulation->gravity;
    batch.trials.reserve(static_cast<std::size_t>(trials));
    if (conditions == TrialConditions::nominal || scene.box == nullptr) {
        for (int i = 0; i < trials; ++i, ++first.trial)
            batch.trials.push_back(trial::drawTrial(*scene.track, *scene.part, policy, first));
        return batch;
    }
    batch.parts = scene.specimens;
    // The purpose keeps places of learning, selection and validation apart.
    const base::StreamKey key{first.seed, first.generation, static_cast<std::uint32_t>(first.purpose), 0,
                              base::Purpose::conditions};
    const BoxPlaces places(*scene.simulation, *scene.box, key, cornerShare);
    for (const trial::BoxPlace& place : places.draw(static_cast<int>(first.trial), trials)) {
        const auto count = static_cast<double>(batch.parts.size());
        const auto specimen = std::min(
            static_cast<std::size_t>(place[static_cast<std::size_t>(trial::Condition::part)] * count),
            batch.parts.size() - 1);
        trial::TrialSpec& spec =
            batch.trials.emplace_back(trial::drawTrial(*scene.track, *batch.parts[specimen], policy, first));
        spec.parts.front().part = specimen;
        putAt(*scene.simulation, *scene.box, place, *scene.track, spec);
        ++first.trial;
    }
    return batch;
}

base::StreamKey keyOf(const TrialScene& scene, const IndividualId& individual, int trial,
                      base::Purpose purpose) {
    return {scene.seed, static_cast<std::uint32_t>(individual.generation),
            static_cast<std::uint32_t>(individual.individual), static_cast<std::uint32_t>(trial), purpose};
}

/// How many times slower a flat part comes up the feeder's slope than along a level one, as predicted; 1
/// where it does not climb, and at most 10, also for what does not come up at all.
double slowdownOn(const SimulationSettings& simulation, const track::FeederShape& shape) {
    constexpr double kMost = 10.0;
    if (shape.slope <= 0.0) return 1.0;
    const double level = predictOnFeeder(simulation, {}).speed;
    const double climbing = predictOnFeeder(simulation, shape).speed;
    return climbing > 0.0 ? std::clamp(level / climbing, 1.0, kMost) : kMost;
}

}  // namespace

trial::ConveyingPrediction predictOnFeeder(const SimulationSettings& simulation,
                                           const track::FeederShape& shape) {
    constexpr std::size_t kMostKnown = 100;
    const trial::Vibration drive = trial::seenFromTrack(simulation.drive, shape);
    const trial::ContactParameters& contact = simulation.contact;
    const std::array<double, 7> key = {
        drive.frequency,     drive.halfStroke,   drive.angle, contact.kineticFriction,
        contact.restitution, simulation.gravity, shape.slope};
    static std::mutex mutex;
    static std::map<std::array<double, 7>, trial::ConveyingPrediction> known;
    const std::scoped_lock lock(mutex);
    if (known.size() > kMostKnown) known.clear();
    const auto [at, isNew] = known.try_emplace(key);
    if (isNew) at->second = trial::predictConveying(drive, contact, simulation.gravity, shape.slope);
    return at->second;
}

trial::Termination terminationOn(const SimulationSettings& simulation, const track::Track& track) {
    constexpr double kSlowest = 20e-3;     // [m/s]
    constexpr double kShortestLimit = 10;  // [s]
    trial::Termination termination = simulation.termination;
    if (termination.timeLimit == 0.0) {
        termination.timeLimit = std::max((track.finish - track.start) / kSlowest, kShortestLimit);
        // In whole seconds, the same on any machine.
        if (const double slowdown = slowdownOn(simulation, track.shape); slowdown > 1.0)
            termination.timeLimit = std::ceil(slowdown * termination.timeLimit);
    }
    return termination;
}

TrialScene makeScene(const Settings& settings, const Specimens& specimens,
                     std::shared_ptr<const track::Track> track) {
    return {&settings.simulation,
            specimens.drawn,
            std::move(track),
            settings.evolution.seed,
            settings.evolution.commonRandomNumbers,
            settings.evolution.learningStuckTime,
            chooseLearningStep(settings),
            &settings.box,
            specimens.varied,
            settings.evolution.conditions,
            settings.evolution.cornerShare,
            settings.evolution.cornersFrom,
            settings.validation.conditions};
}

TrialScene makeScene(const Settings& settings, const std::shared_ptr<const part::Part>& part,
                     std::shared_ptr<const track::Track> track) {
    return makeScene(settings, makeSpecimens(settings, part), std::move(track));
}

trial::TrialBatch makeLearningBatch(const TrialScene& scene, const IndividualId& individual, int trials,
                                    int first) {
    const IndividualId stream{individual.generation, scene.commonRandomNumbers ? 0 : individual.individual};
    trial::TrialBatch batch = makeBatch(
        scene, scene.simulation->start, keyOf(scene, stream, first, base::Purpose::trialStart), trials,
        scene.whileLearning, individual.generation >= scene.cornersFrom ? scene.cornerShare : 0.0);
    double& stuckTime = batch.termination.stuckTime;
    stuckTime = std::min(stuckTime, scene.learningStuckTime.value_or(stuckTime));
    batch.step = scene.learningStep;
    return batch;
}

trial::TrialBatch makeSelectionBatch(const TrialScene& scene, const IndividualId& individual, int trials) {
    return makeBatch(scene, scene.simulation->start,
                     keyOf(scene, individual, 0, base::Purpose::finalSelection), trials, scene.whileJudging);
}

trial::TrialBatch makeCornerBatch(const TrialScene& scene, const IndividualId& individual, int trials) {
    return makeBatch(scene, scene.simulation->start, keyOf(scene, individual, 0, base::Purpose::corners),
                     trials, scene.whileJudging, 1.0);
}

trial::TrialBatch makeValidationBatch(const TrialScene& scene, const IndividualId& individual, int pose,
                                      int trials) {
    trial::StartPolicy policy = scene.simulation->start;
    policy.nearPose = scene.part->stablePoses[static_cast<std::size_t>(pose)].rotation;
    return makeBatch(scene, policy, keyOf(scene, individual, pose * trials, base::Purpose::validation),
                     trials, scene.whileJudging);
}

trial::TrialBatch makeTrackBatch(std::shared_ptr<const track::Track> track,
                                 std::shared_ptr<const part::Part> part, const SimulationSettings& simulation,
                                 std::uint64_t seed, int trials) {
    return makeLearningBatch({&simulation, std::move(part), std::move(track), seed}, {0, 0}, trials);
}

std::vector<trial::BoxPlace> listPlaces(const trial::TrialBatch& batch) {
    std::vector<trial::BoxPlace> places;
    for (const trial::TrialSpec& spec : batch.trials)
        if (spec.place) places.push_back(*spec.place);
    return places;
}

TrialCounts countTrials(std::span<const trial::Outcome> outcomes, const part::SymmetryGroup& symmetry,
                        const std::optional<base::Quaternion>& expected, double tolerance) {
    TrialCounts counts;
    counts.expected =
        expected ? *expected
                 : trial::findModalOrientation(trial::finalOrientations(outcomes), symmetry, tolerance);
    counts.tally = trial::tally(outcomes, trial::makeGoal(counts.expected), symmetry, tolerance);
    for (const trial::Outcome& outcome : outcomes) {
        for (const trial::PartOutcome& part : outcome.parts)
            counts.simulatedTime += part.time;
    }
    return counts;
}

}  // namespace trapwright::study
