#include "sim/simbody/stream_run.h"

#include <algorithm>
#include <cmath>

namespace trapwright::simbody {

StreamScene::StreamScene(const trial::TrialBatch& b)
    : batch(&b), track(contact::prepareTrack(b.track->solid)) {
    for (const auto& part : b.parts)
        bodies.push_back(contact::prepareBody(part->pieces));
}

StreamRun::StreamRun(std::shared_ptr<const StreamScene> scene, std::size_t trial, double dt)
    : scene_(std::move(scene)),
      spec_(&scene_->batch->trials[trial]),
      dt_(dt),
      stepsPerCheck_(std::max(1L, std::lround(contact::kCheckInterval / dt))),
      drive_(scene_->batch->driveOf(*spec_), scene_->batch->track->shape, spec_->phase),
      contact_(scene_->track, drive_, {scene_->batch->contactOf(*spec_), scene_->batch->partsContact}, dt),
      traffic_(*scene_->batch, *spec_) {
    for (std::size_t kind = 0; kind < scene_->bodies.size(); ++kind)
        bodies_.push_back({makeBodies(kind, 1), {false}});
}

FreeBodies StreamRun::makeBodies(std::size_t kind, int count) const {
    const geometry::MassProperties& mass = scene_->batch->parts[kind]->massProperties;
    return {mass.mass, mass.inertia, scene_->batch->gravityVector(), count};
}

void StreamRun::enter(const contact::Traffic::Entry& entry) {
    const trial::PartStart& start = spec_->parts[entry.part];
    Bodies& own = bodies_[start.part];
    auto free = std::ranges::find(own.taken, false);
    if (free == own.taken.end()) {
        const int count = own.bodies.count();
        FreeBodies larger = makeBodies(start.part, 2 * count);
        for (int body = 0; body < count; ++body)
            larger.adopt(body, own.bodies, body);
        own.bodies = std::move(larger);
        own.taken.resize(2 * static_cast<std::size_t>(count), false);
        free = own.taken.begin() + count;
    }
    *free = true;
    const int body = static_cast<int>(free - own.taken.begin());
    own.bodies.place(body, contact_.placement().toRoom(start.pose), {start.velocity, start.angularVelocity},
                     dt_);
    const auto slot = static_cast<std::size_t>(entry.slot);
    if (slot >= places_.size()) {
        places_.resize(slot + 1);
        carrying_.resize(slot + 1, 0);
        since_.resize(slot + 1, 0);
    }
    since_[slot] = steps_;
    places_[slot] = {start.part, body};
    carrying_[slot] = 0;
    contact_.add(entry.slot, scene_->bodies[start.part]);
}

void StreamRun::leave(int slot) {
    contact_.remove(slot);
    const Place& place = places_[static_cast<std::size_t>(slot)];
    bodies_[place.kind].taken[static_cast<std::size_t>(place.body)] = false;
    bodies_[place.kind].bodies.resolve(place.body, {});
}

bool StreamRun::look() {
    return traffic_.look(
        time(), [&](int slot) { return contact_.poseInTrack(bodiesOf(slot).pose(bodyOf(slot))); },
        [&](const contact::Traffic::Entry& entry) {
            enter(entry);
            return spec_->parts[entry.part].pose;
        },
        [&](int slot) { leave(slot); });
}

bool StreamRun::begin() {
    const bool goesOn = steps_ % stepsPerCheck_ != 0 || look();
    for (Bodies& kind : bodies_)
        kind.bodies.beginStep(dt_);
    return goesOn;
}

void StreamRun::finish(trial::CostLaps& laps) {
    parts_.resize(places_.size());
    for (int slot = 0; slot < static_cast<int>(places_.size()); ++slot) {
        contact::SteppedPart& part = parts_[static_cast<std::size_t>(slot)];
        part.inverseInertia.setIdentity();
        if (!traffic_.partOf(slot)) continue;
        const FreeBodies& bodies = bodiesOf(slot);
        const int body = bodyOf(slot);
        part = {bodies.pose(body), bodies.inverseMass(), bodies.inverseInertia(), bodies.before(body),
                bodies.free(body)};
    }
    laps.end(&trial::Costs::integration);
    const auto results = contact_.step(steps_, parts_, laps);
    for (int slot = 0; slot < static_cast<int>(places_.size()); ++slot) {
        if (!traffic_.partOf(slot)) continue;
        const contact::StepResult& result = results[static_cast<std::size_t>(slot)];
        bodies_[places_[static_cast<std::size_t>(slot)].kind].bodies.resolve(bodyOf(slot), result);
        carrying_[static_cast<std::size_t>(slot)] = result.carrying;
    }
    for (Bodies& kind : bodies_)
        kind.bodies.endStep(dt_);
    ++steps_;
}

bool StreamRun::step(trial::CostLaps& laps) {
    if (!begin()) return false;
    finish(laps);
    return true;
}

trial::TrajectorySample StreamRun::sample() const {
    trial::TrajectorySample sample;
    sample.time = time();
    sample.drive = drive_.displacement(sample.time);
    for (int slot = 0; slot < static_cast<int>(places_.size()); ++slot) {
        const auto part = traffic_.partOf(slot);
        if (!part) continue;
        const FreeBodies& bodies = bodiesOf(slot);
        const int body = bodyOf(slot);
        trial::PartState& state = sample.parts.emplace_back();
        state.part = *part;
        state.room = bodies.pose(body);
        state.track = traffic_.progress().toTrackCoordinates(*part, contact_.poseInTrack(state.room));
        const contact::BodyMotion motion = bodies.now(body, dt_);
        state.velocity = motion.velocity;
        state.angularVelocity = motion.angularVelocity;
        state.contacts = carrying_[static_cast<std::size_t>(slot)];
    }
    std::ranges::sort(sample.parts, {}, &trial::PartState::part);
    if (steps_ == 0) return sample;
    const auto nameOf = [&](trial::Body slot) {
        return slot == trial::kTrack ? trial::kTrack : static_cast<trial::Body>(*traffic_.partOf(slot));
    };
    // Whoever came into a slot just now has nothing of what the one before did there.
    const auto isHere = [&](trial::Body slot) {
        return slot == trial::kTrack ||
               (traffic_.partOf(slot) && since_[static_cast<std::size_t>(slot)] < steps_);
    };
    for (trial::ContactForce& force : contact_.forces()) {
        if (!isHere(force.bodyA) || !isHere(force.bodyB)) continue;
        force.bodyA = nameOf(force.bodyA);
        force.bodyB = nameOf(force.bodyB);
        sample.forces.push_back(force);
    }
    return sample;
}

}  // namespace trapwright::simbody
