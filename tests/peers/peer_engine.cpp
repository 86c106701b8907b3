#include "tests/peers/peer_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/base/parallel.h"
#include "core/trial/termination_monitor.h"
#include "sim/contact/drive_motion.h"

namespace trapwright::peers {

namespace {

/// The ending is looked for this often, as in Trapwright's engines. [s]
constexpr double kCheckInterval = 2e-3;

struct Running {
    const trial::TrialBatch& batch;
    const std::vector<std::unique_ptr<PeerScene>>& scenes;  // of the batch's parts
    double dt;
    base::RunControl control;
};

/// Simulates one trial, taking a sample every `interval` (none where it is 0). Nothing if cancelled.
std::optional<trial::Trajectory> simulate(const Running& running, std::size_t index, double interval,
                                          trial::CostLaps& laps) {
    const trial::TrialSpec& spec = running.batch.trials[index];
    const auto trial = running.scenes[spec.parts.front().part]->start(index);
    trial::TerminationMonitor progress(running.batch, spec);
    const contact::DriveMotion drive(running.batch.driveOf(spec), running.batch.track->shape, spec.phase);
    const long stepsPerCheck = std::max(1L, std::lround(kCheckInterval / running.dt));
    trial::Trajectory trajectory;
    for (long step = 0;; ++step) {
        const double time = static_cast<double>(step) * running.dt;
        bool ended = false;
        if (step % stepsPerCheck == 0) {
            if (running.control.cancelled()) return std::nullopt;
            ended = progress.update(0, time, trial->poseInTrack()).has_value();
        }
        const double due = static_cast<double>(trajectory.samples.size()) * interval;
        if (interval > 0.0 && (ended || time + 0.5 * running.dt >= due)) {
            const contact::BodyMotion motion = trial->motion();
            const trial::PartState part{trial->pose(), progress.toTrackCoordinates(0, trial->poseInTrack()),
                                        motion.velocity, motion.angularVelocity, trial->contacts()};
            trajectory.samples.push_back({time, drive.displacement(time), {part}, {}});
        }
        if (ended) break;
        trial->step(laps);
    }
    laps.end(&trial::Costs::integration);
    trajectory.outcome = progress.outcome();
    return trajectory;
}

/// No peer has more than one coefficient of friction, nor our rough surfaces.
std::optional<base::Error> findContactProblem(const trial::TrialBatch& batch, const std::string& engine) {
    for (const trial::TrialSpec& spec : batch.trials) {
        const trial::ContactParameters& contact = batch.contactOf(spec);
        if (contact.staticFriction != contact.kineticFriction)
            return base::Error{
                fmt::format("The engine '{}' has one coefficient of friction; this batch has trials with two "
                            "that differ.",
                            engine)};
        if (contact.roughness > 0.0)
            return base::Error{
                fmt::format("The engine '{}' has no rough surfaces; this batch has trials on one.", engine)};
    }
    return std::nullopt;
}

}  // namespace

PeerEngine::PeerEngine(const trial::EngineOptions& options, double defaultStep)
    : threads_(options.threads > 0 ? options.threads : base::availableThreads()),
      step_(options.step > 0.0 ? options.step : defaultStep),
      costs_(options.costs) {}

base::Result<std::vector<std::unique_ptr<PeerScene>>> PeerEngine::prepareAll(
    const trial::TrialBatch& batch) const {
    if (auto problem = findContactProblem(batch, name())) return *std::move(problem);
    std::vector<std::unique_ptr<PeerScene>> scenes;
    for (const auto& part : batch.parts) {
        auto scene = prepare(batch, *part);
        if (!scene) return scene.error();
        scenes.push_back(std::move(scene).value());
    }
    return scenes;
}

base::Result<std::vector<std::vector<trial::Outcome>>> PeerEngine::run(
    std::span<const trial::TrialBatch> batches, base::RunControl control) const {
    std::vector<std::vector<trial::Outcome>> outcomes;
    for (const trial::TrialBatch& batch : batches) {
        if (const auto problem = findSinglePartProblem(batch, name())) return *problem;
        const auto scenes = prepareAll(batch);
        if (!scenes) return scenes.error();
        std::vector<trial::Outcome>& slots = outcomes.emplace_back(batch.trials.size());
        base::parallelFor(slots.size(), threads_, [&](std::size_t i, unsigned) {
            trial::CostLaps laps(costs_.get());
            if (const auto done =
                    simulate({batch, *scenes, batch.stepOf(step_, step_), control}, i, 0.0, laps)) {
                slots[i] = done->outcome;
                control.advance(1);
            }
        });
    }
    if (control.cancelled()) return base::Error{"The simulation was cancelled."};
    return outcomes;
}

base::Result<trial::Trajectory> PeerEngine::replay(const trial::TrialBatch& batch, std::size_t index,
                                                   double interval, base::RunControl control) const {
    if (const auto problem = findSinglePartProblem(batch, index, name())) return *problem;
    const auto scenes = prepareAll(batch);
    if (!scenes) return scenes.error();
    trial::CostLaps laps(nullptr);
    auto trajectory = simulate({batch, *scenes, batch.stepOf(step_, step_), control}, index, interval, laps);
    if (!trajectory) return base::Error{"The replay was cancelled."};
    control.advance(1);
    return *std::move(trajectory);
}

}  // namespace trapwright::peers
