#include "sim/simbody/certifying_engine.h"

#include <exception>
#include <memory>
#include <utility>

#include "core/base/parallel.h"
#include "core/trial/termination_monitor.h"
#include "sim/contact/trial_queue.h"
#include "sim/simbody/certifying_trial.h"
#include "sim/simbody/trial_lane.h"

namespace trapwright::simbody {

namespace {

/// Simulates one trial, taking a sample every `interval` (none where it is 0). Nothing if cancelled.
std::optional<trial::Trajectory> simulate(const Scene& scene, std::size_t index, double checkInterval,
                                          double interval, const base::RunControl& control) {
    const trial::TrialBatch& batch = *scene.batch;
    const trial::TrialSpec& spec = batch.trials[index];
    const trial::PartStart& start = spec.parts.front();
    const trial::Vibration& vibration = batch.driveOf(spec);
    const geometry::MassProperties& mass = batch.partOf(spec).massProperties;
    const contact::DriveMotion drive(vibration, batch.track->shape, spec.phase);
    const contact::TrackPlacement placement = drive.placement(0.0);
    CertifyingTrial running({&scene.track, &scene.body, batch.track->shape, vibration, spec.phase, mass.mass,
                             mass.inertia, batch.gravityVector(), batch.contactOf(spec)},
                            placement.toRoom(start.pose), {start.velocity, start.angularVelocity});
    trial::TerminationMonitor progress(batch, spec);
    trial::Trajectory trajectory;
    long checks = 0;
    double time = 0.0;
    while (true) {
        if (!control.mayGoOn()) return std::nullopt;
        const double checkTime = static_cast<double>(checks) * checkInterval;
        const double sampleTime = static_cast<double>(trajectory.samples.size()) * interval;
        const bool sampling = interval > 0.0 && sampleTime <= checkTime;
        time = sampling ? sampleTime : checkTime;
        running.advanceTo(time);
        if (sampling) {
            const contact::BodyMotion motion = running.motion();
            const trial::PartState part{running.pose(), progress.toTrackCoordinates(0, running.poseInTrack()),
                                        motion.velocity, motion.angularVelocity,
                                        static_cast<int>(running.forces().size())};
            trajectory.samples.push_back({time, drive.displacement(time), {part}, running.forces()});
            continue;
        }
        ++checks;
        if (progress.update(0, time, running.poseInTrack())) break;
    }
    trajectory.outcome = progress.outcome();
    return trajectory;
}

}  // namespace

CertifyingEngine::CertifyingEngine(const trial::EngineOptions& options)
    : threads_(options.threads > 0 ? options.threads : base::availableThreads()),
      step_(options.step > 0.0 ? options.step : kDefaultStep) {}

base::Result<std::vector<std::vector<trial::Outcome>>> CertifyingEngine::run(
    std::span<const trial::TrialBatch> batches, base::RunControl control) const {
    std::vector<std::vector<trial::Outcome>> outcomes;
    for (const trial::TrialBatch& batch : batches) {
        if (const auto problem = findSinglePartProblem(batch, kName)) return *problem;
        outcomes.emplace_back(batch.trials.size());
    }
    try {
        for (const contact::LikeTrials& like : contact::groupLikeTrials(batches)) {
            for (const contact::LikeTrials::Member& member : like.members) {
                const Scene scene(batches[member.batch], *like.part);
                base::parallelFor(member.trials.size(), threads_, [&](std::size_t i, unsigned) {
                    const std::size_t trial = member.trials[i];
                    if (auto trajectory = simulate(scene, trial, step_, 0.0, control)) {
                        outcomes[member.batch][trial] = trajectory->outcome;
                        control.advance(1);
                    }
                });
            }
        }
    } catch (const std::exception& e) {
        return base::Error{std::string("Simbody could not simulate the trials: ") + e.what()};
    }
    if (control.cancelled()) return base::Error{"The simulation was cancelled."};
    return outcomes;
}

base::Result<trial::Trajectory> CertifyingEngine::replay(const trial::TrialBatch& batch, std::size_t index,
                                                         double interval, base::RunControl control) const {
    if (const auto problem = findSinglePartProblem(batch, index, kName)) return *problem;
    try {
        auto trajectory =
            simulate(Scene(batch, batch.partOf(batch.trials[index])), index, step_, interval, control);
        if (!trajectory) return base::Error{"The replay was cancelled."};
        control.advance(1);
        return *std::move(trajectory);
    } catch (const std::exception& e) {
        return base::Error{std::string("Simbody could not replay the trial: ") + e.what()};
    }
}

}  // namespace trapwright::simbody
