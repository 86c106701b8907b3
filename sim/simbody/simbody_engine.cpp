#include "sim/simbody/simbody_engine.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/base/parallel.h"
#include "sim/contact/trial_queue.h"
#include "sim/simbody/free_bodies.h"
#include "sim/simbody/stream_run.h"
#include "sim/simbody/trial_lane.h"

namespace trapwright::simbody {

namespace {

/// How many steps are made between two looks at the run control.
constexpr int kStepsPerLook = 50;

using TrialQueue = contact::TrialQueue<Scene>;

/// One thread's work: its own system, its lanes.
class Worker {
 public:
    Worker(const contact::LikeTrials& like, TrialQueue& queue, int count, double dt,
           std::vector<std::vector<trial::Outcome>>& outcomes)
        : like_(&like),
          queue_(&queue),
          dt_(dt),
          outcomes_(&outcomes),
          bodies_(makeBodies(count)),
          lanes_(count) {}

    void run(base::RunControl& control, trial::CostMeter* costs) {
        trial::CostLaps laps(costs);
        for (int slot = 0; slot < static_cast<int>(lanes_.size()); ++slot)
            fill(slot);
        for (long step = 0; shrink(); ++step) {
            if (step % kStepsPerLook == 0 && !control.mayGoOn()) return;
            bodies_.beginStep(dt_);
            for (int slot = 0; slot < static_cast<int>(lanes_.size()); ++slot) {
                if (!lanes_[slot]) continue;
                if (!lanes_[slot]->lane.step(bodies_, slot, laps)) continue;
                const Lane& done = *lanes_[slot];
                (*outcomes_)[done.batch][done.trial] = done.lane.outcome();
                control.advance(1);
                ended_.push_back(slot);
            }
            bodies_.endStep(dt_);
            for (const int slot : ended_)
                fill(slot);
            ended_.clear();
        }
        laps.end(&trial::Costs::integration);
    }

 private:
    struct Lane {
        TrialLane lane;
        std::size_t batch;
        std::size_t trial;
    };

    [[nodiscard]] FreeBodies makeBodies(int count) const {
        const geometry::MassProperties& mass = like_->part->massProperties;
        return {mass.mass, mass.inertia, like_->batch->gravityVector(), count};
    }

    void fill(int slot) {
        lanes_[slot].reset();
        if (const auto job = queue_->next())
            lanes_[slot].emplace(
                Lane{TrialLane(job->scene, job->trial, bodies_, slot, dt_), job->batch, job->trial});
        else
            bodies_.resolve(slot, {});
    }

    /// Moves the last running trials to a smaller system. False when none is left.
    bool shrink() {
        const auto running = static_cast<std::size_t>(
            std::count_if(lanes_.begin(), lanes_.end(), [](const auto& lane) { return lane.has_value(); }));
        if (running == 0) return false;
        if (2 * running > lanes_.size()) return true;
        FreeBodies smaller = makeBodies(static_cast<int>(running));
        std::vector<std::optional<Lane>> kept;
        for (std::size_t slot = 0; slot < lanes_.size(); ++slot) {
            if (!lanes_[slot]) continue;
            smaller.adopt(static_cast<int>(kept.size()), bodies_, static_cast<int>(slot));
            kept.push_back(std::move(lanes_[slot]));
        }
        bodies_ = std::move(smaller);
        lanes_ = std::move(kept);
        return true;
    }

    const contact::LikeTrials* like_;
    TrialQueue* queue_;
    double dt_;
    std::vector<std::vector<trial::Outcome>>* outcomes_;
    FreeBodies bodies_;
    std::vector<std::optional<Lane>> lanes_;
    std::vector<int> ended_;
};

}  // namespace

SimbodyEngine::SimbodyEngine(const trial::EngineOptions& options)
    : threads_(options.threads > 0 ? options.threads : base::availableThreads()),
      step_(options.step),
      costs_(options.costs) {}

base::Result<std::vector<std::vector<trial::Outcome>>> SimbodyEngine::run(
    std::span<const trial::TrialBatch> batches, base::RunControl control) const {
    std::vector<std::vector<trial::Outcome>> outcomes;
    for (const trial::TrialBatch& batch : batches) {
        if (const auto problem = findProblem(batch)) return *problem;
        outcomes.emplace_back(batch.trials.size());
    }

    // One system holds like bodies: take the batches part by part.
    for (const contact::LikeTrials& like : contact::groupLikeTrials(batches)) {
        TrialQueue queue(like.members, [&](std::size_t b) {
            return std::make_shared<const Scene>(batches[b], *like.part);
        });
        const std::size_t perThread = (queue.total() + threads_ - 1) / threads_;
        const int bodies = static_cast<int>(std::clamp<std::size_t>(perThread, 1, kBodiesPerSystem));
        try {
            base::parallelFor(threads_, threads_, [&](std::size_t, unsigned) {
                Worker(like, queue, bodies, like.batch->stepOf(step_, kDefaultStep), outcomes)
                    .run(control, costs_.get());
            });
        } catch (const std::exception& e) {
            return base::Error{std::string("Simbody could not simulate the trials: ") + e.what()};
        }
        if (control.cancelled()) return base::Error{"The simulation was cancelled."};
    }
    for (const contact::LikeTrials& like : contact::groupLikeStreams(batches)) {
        contact::TrialQueue<StreamScene> queue(
            like.members, [&](std::size_t b) { return std::make_shared<const StreamScene>(batches[b]); });
        const double step = like.batch->stepOf(step_, kDefaultStep);
        try {
            base::parallelFor(threads_, threads_, [&](std::size_t, unsigned) {
                trial::CostLaps laps(costs_.get());
                while (const auto job = queue.next()) {
                    StreamRun run(job->scene, job->trial, step);
                    for (long steps = 1; run.step(laps); ++steps)
                        if (steps % kStepsPerLook == 0 && !control.mayGoOn()) return;
                    outcomes[job->batch][job->trial] = run.outcome();
                    control.advance(1);
                }
            });
        } catch (const std::exception& e) {
            return base::Error{std::string("Simbody could not simulate the trials: ") + e.what()};
        }
        if (control.cancelled()) return base::Error{"The simulation was cancelled."};
    }
    return outcomes;
}

base::Result<trial::Trajectory> SimbodyEngine::replayStream(const trial::TrialBatch& batch, std::size_t index,
                                                            double interval, base::RunControl control) const {
    try {
        const double step = batch.stepOf(step_, kDefaultStep);
        StreamRun run(std::make_shared<const StreamScene>(batch), index, step);
        trial::CostLaps laps(nullptr);
        trial::Trajectory trajectory;
        while (true) {
            if (!control.mayGoOn()) return base::Error{"The replay was cancelled."};
            const double time = run.time();
            const bool goesOn = run.begin();
            if (!goesOn || time + 0.5 * step >= static_cast<double>(trajectory.samples.size()) * interval)
                trajectory.samples.push_back(run.sample());
            if (!goesOn) break;
            run.finish(laps);
        }
        trajectory.outcome = run.outcome();
        control.advance(1);
        return trajectory;
    } catch (const std::exception& e) {
        return base::Error{std::string("Simbody could not replay the trial: ") + e.what()};
    }
}

base::Result<trial::Trajectory> SimbodyEngine::replay(const trial::TrialBatch& batch, std::size_t index,
                                                      double interval, base::RunControl control) const {
    if (const auto problem = findProblem(batch, index)) return *problem;
    if (!isOfOnePart(batch, batch.trials[index])) return replayStream(batch, index, interval, control);
    try {
        const part::Part& part = batch.partOf(batch.trials[index]);
        const geometry::MassProperties& mass = part.massProperties;
        FreeBodies bodies(mass.mass, mass.inertia, batch.gravityVector(), 1);
        const double step = batch.stepOf(step_, kDefaultStep);
        TrialLane lane(std::make_shared<const Scene>(batch, part), index, bodies, 0, step);
        trial::CostLaps laps(nullptr);
        trial::Trajectory trajectory;
        while (true) {
            if (!control.mayGoOn()) return base::Error{"The replay was cancelled."};
            bodies.beginStep(step);
            const trial::TrajectorySample sample = lane.sample(bodies, 0);
            const bool ended = lane.step(bodies, 0, laps).has_value();
            if (ended ||
                sample.time + 0.5 * step >= static_cast<double>(trajectory.samples.size()) * interval)
                trajectory.samples.push_back(sample);
            if (ended) break;
            bodies.endStep(step);
        }
        trajectory.outcome = lane.outcome();
        control.advance(1);
        return trajectory;
    } catch (const std::exception& e) {
        return base::Error{std::string("Simbody could not replay the trial: ") + e.what()};
    }
}

}  // namespace trapwright::simbody
