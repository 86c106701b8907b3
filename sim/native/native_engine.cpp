#include "sim/native/native_engine.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include "core/base/parallel.h"
#include "core/trial/termination_monitor.h"
#include "sim/contact/drive_motion.h"
#include "sim/contact/traffic.h"
#include "sim/contact/trial_queue.h"
#include "sim/native/kernel.h"
#include "sim/native/stream_trial.h"

namespace trapwright::native {

namespace {

/// How many trials one thread runs side by side: enough that lanes with like numbers of contacts find each
/// other, few enough that all stays in the cache.
constexpr int kLanes = 256;
/// How many steps are made between two looks at the run control.
constexpr int kStepsPerLook = 50;

using TrialQueue = contact::TrialQueue<Scene>;

/// The trial in one lane of a group.
struct Run {
    Run(std::shared_ptr<const Scene> s, std::size_t b, std::size_t t)
        : scene(std::move(s)), batch(b), trial(t), progress(*scene->batch, scene->batch->trials[t]) {}

    std::shared_ptr<const Scene> scene;
    std::size_t batch;
    std::size_t trial;
    trial::TerminationMonitor progress;
    long steps = 0;
    int untilCheck = 0;
};

/// Trials in the lanes of a group, with what the group does not know of them.
class RunningTrials {
 public:
    RunningTrials(const LaneModel& model, int lanes)
        : group_(model, lanes),
          stepsPerCheck_(static_cast<int>(std::max(1L, std::lround(contact::kCheckInterval / model.step)))) {}

    void add(std::shared_ptr<const Scene> scene, std::size_t batch, std::size_t trial) {
        group_.add(scene->track, *scene->batch, scene->batch->trials[trial]);
        runs_.emplace_back(std::move(scene), batch, trial);
    }
    void remove(int lane) {
        group_.remove(lane);
        if (static_cast<std::size_t>(lane) + 1 < runs_.size()) runs_[lane] = std::move(runs_.back());
        runs_.pop_back();
    }

    /// Whether the trial of this lane is over; to be asked once before each step.
    bool hasEnded(int lane) {
        Run& run = runs_[lane];
        if (run.untilCheck-- > 0) return false;
        run.untilCheck = stepsPerCheck_ - 1;
        return run.progress.update(0, time(lane), group_.poseInTrack(lane)).has_value();
    }
    /// One step of all lanes.
    void step() {
        beginStep(group_);
        finish();
    }
    /// The second half of a step whose first half is made.
    void finish() {
        finishStep(group_);
        for (Run& run : runs_)
            ++run.steps;
    }

    [[nodiscard]] int count() const { return group_.count(); }
    [[nodiscard]] TrialLanes& group() { return group_; }
    [[nodiscard]] const Run& run(int lane) const { return runs_[lane]; }
    [[nodiscard]] double time(int lane) const {
        return static_cast<double>(runs_[lane].steps) * group_.model().step;
    }

 private:
    TrialLanes group_;
    std::vector<Run> runs_;
    int stepsPerCheck_;
};

/// One thread's work.
void runTrials(const LaneModel& model, TrialQueue& queue, int lanes,
               std::vector<std::vector<trial::Outcome>>& outcomes, trial::CostMeter* costs,
               base::RunControl& control) {
    trial::CostLaps laps(costs);
    RunningTrials trials(model, lanes);
    if (costs != nullptr) trials.group().laps = &laps;
    const auto removeIfEnded = [&](int lane) {
        if (!trials.hasEnded(lane)) return false;
        const Run& run = trials.run(lane);
        outcomes[run.batch][run.trial] = run.progress.outcome();
        control.advance(1);
        trials.remove(lane);
        return true;
    };
    bool more = true;
    for (long step = 0;; ++step) {
        if (step % kStepsPerLook == 0 && !control.mayGoOn()) return;
        for (int lane = 0; lane < trials.count();)
            lane += removeIfEnded(lane) ? 0 : 1;
        while (more && trials.count() < lanes) {
            auto job = queue.next();
            more = job.has_value();
            if (!more) break;
            trials.add(std::move(job->scene), job->batch, job->trial);
            removeIfEnded(trials.count() - 1);  // it may begin past the finish
        }
        if (trials.count() == 0) return;
        trials.step();
        laps.end(&trial::Costs::integration);
    }
}

bool isBowl(const trial::TrialBatch& batch) {
    return batch.track->shape.type == track::FeederType::bowl;
}

/// The moment at the begin of the coming step, whose first half is made.
trial::TrajectorySample sampleOf(RunningTrials& trials, const contact::DriveMotion& drive) {
    trial::TrajectorySample sample;
    sample.time = trials.time(0);
    sample.drive = drive.displacement(sample.time);
    sample.parts.push_back(describeState(trials.group(), 0, trials.run(0).progress, 0));
    return sample;
}

/// Parts that a stream is reckoned to have at once, at least: it begins with few.
constexpr int kPartsOfStream = 16;

/// A stream in the lanes of a thread.
struct StreamRun {
    StreamTrial trial;
    std::size_t batch;
    std::size_t index;
};

/// One thread's work, of streams: at most so many side by side.
void runStreams(const StreamParts& kinds, double step, TrialQueue& queue, std::size_t most,
                std::vector<std::vector<trial::Outcome>>& outcomes, trial::CostMeter* costs,
                base::RunControl& control) {
    trial::CostLaps laps(costs);
    StreamLanes lanes(kinds);
    if (costs != nullptr) lanes.measure(laps);
    std::vector<std::unique_ptr<StreamRun>> runs;
    const auto goesOn = [&](StreamRun& run) {
        if (run.trial.look()) return true;
        outcomes[run.batch][run.index] = run.trial.outcome();
        run.trial.clear();
        control.advance(1);
        return false;
    };
    const auto hasRoom = [&] {
        int parts = 0;
        for (const auto& run : runs)
            parts += std::max(run->trial.partCount(), kPartsOfStream);
        return runs.size() < most && parts < kLanes;
    };
    bool more = true;
    for (long steps = 0;; ++steps) {
        if (steps % kStepsPerLook == 0 && !control.mayGoOn()) return;
        std::erase_if(runs, [&](const auto& run) { return !goesOn(*run); });
        while (more && hasRoom()) {
            auto job = queue.next();
            more = job.has_value();
            if (!more) break;
            auto run = std::make_unique<StreamRun>(StreamRun{
                StreamTrial(std::move(job->scene), job->trial, lanes, step), job->batch, job->trial});
            if (goesOn(*run)) runs.push_back(std::move(run));
        }
        if (runs.empty()) return;
        lanes.beginStep();
        laps.end(&trial::Costs::integration);
        for (const auto& run : runs)
            run->trial.findPartContacts();
        laps.end(&trial::Costs::detection);
        lanes.findContacts();
        for (const auto& run : runs)
            run->trial.solveIslands();
        laps.end(&trial::Costs::law);
        lanes.solveAndMove();
        for (const auto& run : runs)
            run->trial.endStep();
        laps.end(&trial::Costs::integration);
    }
}

StreamParts prepareParts(const trial::TrialBatch& batch, double step, bool anyBowl) {
    StreamParts kinds;
    for (const auto& part : batch.parts)
        kinds.push_back(std::make_unique<const StreamPart>(*part, batch.gravityVector(), step, anyBowl));
    return kinds;
}

base::Result<trial::Trajectory> replayStream(const trial::TrialBatch& batch, std::size_t index, double step,
                                             double interval, base::RunControl control) {
    const StreamParts kinds = prepareParts(batch, step, isBowl(batch));
    StreamLanes lanes(kinds);
    lanes.record();
    StreamTrial run(std::make_shared<const Scene>(batch), index, lanes, step);
    std::vector<trial::ContactForce> forces;
    trial::Trajectory trajectory;
    while (true) {
        if (!control.mayGoOn()) return base::Error{"The replay was cancelled."};
        const bool goesOn = run.look();
        lanes.beginStep();
        if (!goesOn || run.time() + 0.5 * step >= static_cast<double>(trajectory.samples.size()) * interval) {
            trajectory.samples.push_back(run.sample());
            trial::TrajectorySample& sample = trajectory.samples.back();
            // Of those that have not left meanwhile.
            const auto isHere = [&](trial::Body body) {
                return body == trial::kTrack ||
                       std::ranges::find(sample.parts, static_cast<std::size_t>(body),
                                         &trial::PartState::part) != sample.parts.end();
            };
            std::ranges::copy_if(forces, std::back_inserter(sample.forces), [&](const auto& force) {
                return isHere(force.bodyA) && isHere(force.bodyB);
            });
        }
        if (!goesOn) break;
        run.findPartContacts();
        lanes.findContacts();
        run.rememberPlaces();
        run.solveIslands();
        lanes.solveAndMove();
        forces = run.forces();
        run.endStep();
    }
    trajectory.outcome = run.outcome();
    control.advance(1);
    return trajectory;
}

}  // namespace

NativeEngine::NativeEngine(const trial::EngineOptions& options)
    : threads_(options.threads > 0 ? options.threads : base::availableThreads()),
      step_(options.step),
      costs_(options.costs) {}

std::string NativeEngine::instructionSet() const {
    return native::instructionSet();
}

base::Result<std::vector<std::vector<trial::Outcome>>> NativeEngine::run(
    std::span<const trial::TrialBatch> batches, base::RunControl control) const {
    std::vector<std::vector<trial::Outcome>> outcomes;
    for (const trial::TrialBatch& batch : batches) {
        if (const auto problem = findProblem(batch)) return *problem;
        outcomes.emplace_back(batch.trials.size());
    }
    // A track is prepared once for all kinds of parts that come onto it.
    std::vector<std::shared_ptr<const Scene>> scenes(batches.size());
    const auto sceneOf = [&](std::size_t b) {
        if (scenes[b]) return scenes[b];
        auto scene = std::make_shared<const Scene>(batches[b]);
        if (batches[b].parts.size() > 1) scenes[b] = scene;
        return scene;
    };
    const auto hasBowl = [&](const contact::LikeTrials& like) {
        return std::ranges::any_of(like.members,
                                   [&](const auto& member) { return isBowl(batches[member.batch]); });
    };
    for (const contact::LikeTrials& like : contact::groupLikeTrials(batches)) {
        const PackedBody body(contact::prepareBody(like.part->pieces));
        const LaneModel model(*like.part, body, like.batch->gravityVector(),
                              like.batch->stepOf(step_, kDefaultStep), hasBowl(like));
        TrialQueue queue(like.members, sceneOf);
        const std::size_t perThread = (queue.total() + threads_ - 1) / threads_;
        const int lanes = static_cast<int>(std::clamp<std::size_t>(perThread, 1, kLanes));
        try {
            base::parallelFor(threads_, threads_, [&](std::size_t, unsigned) {
                runTrials(model, queue, lanes, outcomes, costs_.get(), control);
            });
        } catch (const std::exception& e) {
            return base::Error{std::string("The native engine could not simulate the trials: ") + e.what()};
        }
        if (control.cancelled()) return base::Error{"The simulation was cancelled."};
    }
    for (const contact::LikeTrials& like : contact::groupLikeStreams(batches)) {
        const double step = like.batch->stepOf(step_, kDefaultStep);
        const StreamParts kinds = prepareParts(*like.batch, step, hasBowl(like));
        TrialQueue queue(like.members, sceneOf);
        const std::size_t perThread = (queue.total() + threads_ - 1) / threads_;
        try {
            base::parallelFor(threads_, threads_, [&](std::size_t, unsigned) {
                runStreams(kinds, step, queue, perThread, outcomes, costs_.get(), control);
            });
        } catch (const std::exception& e) {
            return base::Error{std::string("The native engine could not simulate the trials: ") + e.what()};
        }
        if (control.cancelled()) return base::Error{"The simulation was cancelled."};
    }
    return outcomes;
}

base::Result<trial::Trajectory> NativeEngine::replay(const trial::TrialBatch& batch, std::size_t index,
                                                     double interval, base::RunControl control) const {
    if (const auto problem = findProblem(batch, index)) return *problem;
    const trial::TrialSpec& spec = batch.trials[index];
    if (!isOfOnePart(batch, spec))
        return replayStream(batch, index, batch.stepOf(step_, kDefaultStep), interval, control);
    const part::Part& part = batch.partOf(spec);
    const PackedBody body(contact::prepareBody(part.pieces));
    const double step = batch.stepOf(step_, kDefaultStep);
    const LaneModel model(part, body, batch.gravityVector(), step, isBowl(batch));
    const contact::DriveMotion drive(batch.driveOf(spec), batch.track->shape, spec.phase);
    RunningTrials trials(model, 1);
    trials.add(std::make_shared<const Scene>(batch), 0, index);
    std::vector<RecordedImpulse> recorded;
    trials.group().recorded = &recorded;
    std::vector<trial::ContactForce> forces;
    trial::Trajectory trajectory;
    while (true) {
        if (!control.mayGoOn()) return base::Error{"The replay was cancelled."};
        const bool ended = trials.hasEnded(0);
        beginStep(trials.group());
        trial::TrajectorySample sample = sampleOf(trials, drive);
        sample.forces = forces;
        if (ended || sample.time + 0.5 * step >= static_cast<double>(trajectory.samples.size()) * interval)
            trajectory.samples.push_back(sample);
        if (ended) break;
        recorded.clear();
        const base::Vec3 centre = trials.group().poseInTrack(0).position;
        const contact::TrackPlacement placement = drive.placement(trials.time(0));
        trials.finish();
        const double rate = part.massProperties.mass / step;
        forces.clear();
        for (const RecordedImpulse& given : recorded)
            forces.push_back(
                {trial::kTrack, 0, centre + given.arm, rate * placement.turnBack(given.impulse)});
    }
    trajectory.outcome = trials.run(0).progress.outcome();
    control.advance(1);
    return trajectory;
}

}  // namespace trapwright::native
