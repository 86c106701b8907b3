#include "sim/simbody/trial_lane.h"

#include <algorithm>
#include <cmath>

namespace trapwright::simbody {

namespace {

/// The ending is looked for this often. [s]
constexpr double kCheckInterval = 2e-3;

}  // namespace

Scene::Scene(const trial::TrialBatch& b, const part::Part& part)
    : batch(&b), track(contact::prepareTrack(b.track->solid)), body(contact::prepareBody(part.pieces)) {}

TrialLane::TrialLane(std::shared_ptr<const Scene> scene, std::size_t trial, FreeBodies& bodies, int slot,
                     double dt)
    : scene_(std::move(scene)),
      dt_(dt),
      stepsPerCheck_(std::max(1L, std::lround(kCheckInterval / dt))),
      drive_(scene_->batch->driveOf(scene_->batch->trials[trial]), scene_->batch->track->shape,
             scene_->batch->trials[trial].phase),
      contact_(scene_->track, drive_,
               {scene_->batch->contactOf(scene_->batch->trials[trial]), scene_->batch->partsContact}, dt),
      progress_(*scene_->batch, scene_->batch->trials[trial]) {
    contact_.add(0, scene_->body);
    // At rest in the room, where the track is at the drive's phase.
    const trial::PartStart& start = scene_->batch->trials[trial].parts.front();
    bodies.place(slot, drive_.placement(0.0).toRoom(start.pose), {start.velocity, start.angularVelocity}, dt);
}

std::optional<trial::Ending> TrialLane::step(FreeBodies& bodies, int slot, trial::CostLaps& laps) {
    const base::Pose pose = bodies.pose(slot);
    if (steps_ % stepsPerCheck_ == 0) {
        const auto ending = progress_.update(0, time(), contact_.poseInTrack(pose));
        if (ending) return ending;
    }
    laps.end(&trial::Costs::integration);
    const contact::SteppedPart part{pose, bodies.inverseMass(), bodies.inverseInertia(), bodies.before(slot),
                                    bodies.free(slot)};
    const contact::StepResult result = contact_.step(steps_, {&part, 1}, laps).front();
    bodies.resolve(slot, result);
    carrying_ = result.carrying;
    ++steps_;
    return std::nullopt;
}

trial::TrajectorySample TrialLane::sample(const FreeBodies& bodies, int slot) const {
    trial::TrajectorySample sample;
    sample.time = time();
    sample.drive = drive_.displacement(sample.time);
    trial::PartState& part = sample.parts.emplace_back();
    part.room = bodies.pose(slot);
    part.track = progress_.toTrackCoordinates(0, contact_.poseInTrack(part.room));
    const contact::BodyMotion motion = bodies.now(slot, dt_);
    part.velocity = motion.velocity;
    part.angularVelocity = motion.angularVelocity;
    part.contacts = carrying_;
    if (steps_ > 0) sample.forces = contact_.forces();
    return sample;
}

}  // namespace trapwright::simbody
