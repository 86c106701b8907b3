#include "sim/native/stream_trial.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trapwright::native {

using base::Vec3;

namespace {

Vec3 three(const TrialLanes& group, int field, int lane) {
    return {group.field(field)[lane], group.field(field + 1)[lane], group.field(field + 2)[lane]};
}

void setThree(TrialLanes& group, int field, int lane, const Vec3& value) {
    for (int k = 0; k < 3; ++k)
        group.field(field + k)[lane] = static_cast<float>(value[k]);
}

contact::BodyMotion motion(const TrialLanes& group, int velocity, int spin, int lane) {
    return {three(group, velocity, lane), three(group, spin, lane)};
}

/// How a lane's track moves, at places in the room's axes from its part's centre.
struct TrackMotion {
    TrackMotion(const TrialLanes& group, int lane) {
        const auto get = [&](int field) { return static_cast<double>(group.field(field)[lane]); };
        sine = get(kSine);
        cosineLess = get(kCosineLess);
        now = {get(kRateX), get(kRateZ), get(kSineRate), get(kCosineLessRate)};
        before = {get(kRateBeforeX), get(kRateBeforeZ), get(kSineRateBefore), get(kCosineLessRateBefore)};
        x = group.position(0)[lane];
        y = group.position(1)[lane];
    }

    struct Rates {
        double x, z, sine, cosineLess;
    };
    double sine, cosineLess;
    Rates now, before;  // over this step and the one before
    double x, y;

    [[nodiscard]] Vec3 toRoom(const Vec3& v) const {
        return {v.x() + cosineLess * v.x() - sine * v.y(), v.y() + sine * v.x() + cosineLess * v.y(), v.z()};
    }
    [[nodiscard]] Vec3 velocity(const Rates& rates, const Vec3& arm) const {
        const double px = x + arm.x();
        const double py = y + arm.y();
        return {rates.x + rates.cosineLess * px - rates.sine * py, rates.sine * px + rates.cosineLess * py,
                rates.z};
    }
};

}  // namespace

StreamTrial::StreamTrial(std::shared_ptr<const Scene> scene, std::size_t trial, StreamLanes& lanes, double dt)
    : scene_(std::move(scene)),
      spec_(&scene_->batch->trials[trial]),
      lanes_(&lanes),
      dt_(dt),
      stepsPerCheck_(std::max(1L, std::lround(contact::kCheckInterval / dt))),
      drive_(scene_->batch->driveOf(*spec_), scene_->batch->track->shape, spec_->phase),
      traffic_(*scene_->batch, *spec_),
      laws_{scene_->batch->contactOf(*spec_), scene_->batch->partsContact} {}

void StreamTrial::enter(const contact::Traffic::Entry& entry) {
    const auto place = static_cast<std::size_t>(entry.slot);
    if (place >= slots_.size()) {
        slots_.resize(place + 1);
        positions_.resize(place + 1);
        nearParts_.resize(place + 1);
        bodies_.resize(place + 1);
    }
    slots_[place] = {};
    slots_[place].taken = true;
    slots_[place].handle = lanes_->enter(scene_->track, *scene_->batch, *spec_, entry.part, steps_);
    pairs_.add(entry.slot, lanes_->kindOf(slots_[place].handle).body);
    ++present_;
}

void StreamTrial::leave(int slot) {
    lanes_->leave(at(slot).handle);
    pairs_.remove(slot);
    solver_.forget(slot);
    at(slot) = {};
    --present_;
}

bool StreamTrial::look() {
    if (steps_ % stepsPerCheck_ != 0) return true;
    const auto poseOf = [&](int slot) {
        const int handle = at(slot).handle;
        return lanes_->groupOf(handle).poseInTrack(lanes_->laneOf(handle));
    };
    return traffic_.look(
        time(), poseOf,
        [&](const contact::Traffic::Entry& entry) {
            enter(entry);
            return poseOf(entry.slot);
        },
        [&](int slot) { leave(slot); });
}

void StreamTrial::clear() {
    for (Slot& slot : slots_)
        if (slot.taken) lanes_->leave(slot.handle);
    slots_.clear();
}

void StreamTrial::describe(int slot) {
    Slot& own = at(slot);
    if (own.isNear) return;
    const TrialLanes& group = lanes_->groupOf(own.handle);
    const int lane = lanes_->laneOf(own.handle);
    own.isNear = true;
    own.lastPose = own.pose;
    own.pose = group.poseInRoom(lane);
    own.pose.rotation.normalize();
    const double radius = lanes_->kindOf(own.handle).body.radius;
    contact::NearPart& part = nearParts_[static_cast<std::size_t>(slot)];
    part = {own.pose, three(group, kAfterX, lane), Vec3::Zero(),
            three(group, kAfterSpinX, lane).norm() * dt_ * radius, 0.0};
    if (!own.wasNear) return;
    part.lastVelocity = (own.pose.position - own.lastPose.position) / dt_;
    // Twice the chord of the half angle is more than the chord of the whole one.
    part.lastTurn = 2.0 * radius * (own.pose.rotation.coeffs() - own.lastPose.rotation.coeffs()).norm();
}

void StreamTrial::touchAll() {
    if (partContacts_.empty()) return;
    islandOf_.resize(slots_.size());
    std::iota(islandOf_.begin(), islandOf_.end(), 0);
    for (const contact::PartContact& found : partContacts_) {
        Slot& own = at(found.contact.bodyA);
        Slot& other = at(found.contact.bodyB);
        own.touched = true;
        other.touched = true;
        const int a = islandOf_[static_cast<std::size_t>(found.contact.bodyA)];
        const int b = islandOf_[static_cast<std::size_t>(found.contact.bodyB)];
        if (a != b) std::ranges::replace(islandOf_, std::max(a, b), std::min(a, b));
    }
    // A blow goes on from part to part: each may be pushed as far as any two come nearer to each other.
    pushed_.assign(slots_.size(), 0.0);
    for (const contact::PartContact& found : partContacts_) {
        double& pushed =
            pushed_[static_cast<std::size_t>(islandOf_[static_cast<std::size_t>(found.contact.bodyB)])];
        pushed = std::max(pushed, found.reach);
    }
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
        if (!slots_[slot].touched) continue;
        TrialLanes& group = lanes_->groupOf(slots_[slot].handle);
        const int lane = lanes_->laneOf(slots_[slot].handle);
        group.touched[static_cast<std::size_t>(lane)] = 1;
        group.field(kPushed)[lane] =
            static_cast<float>(pushed_[static_cast<std::size_t>(islandOf_[slot])] + contact::kTravelMargin);
    }
}

void StreamTrial::findPartContacts() {
    partContacts_.clear();
    if (present_ < 2 && !anyNear_) return;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        Slot& slot = slots_[i];
        if (!slot.taken) continue;
        TrialLanes& group = lanes_->groupOf(slot.handle);
        const int lane = lanes_->laneOf(slot.handle);
        positions_[i] = {group.position(0)[lane], group.position(1)[lane], group.position(2)[lane]};
        slot.wasNear = slot.isNear;
        slot.isNear = false;
        if (!slot.touched) continue;
        slot.touched = false;
        group.touched[static_cast<std::size_t>(lane)] = 0;
        group.field(kPushed)[lane] = 0.0F;
    }
    const auto& near = pairs_.findNear(positions_);
    anyNear_ = !near.empty();
    if (!anyNear_) return;
    for (const contact::PartPairs::Pair& pair : near) {
        describe(pair.a);
        describe(pair.b);
    }
    pairs_.findContacts(nearParts_, dt_, partContacts_);
    touchAll();
}

void StreamTrial::addTrackContacts(int slot) {
    const Slot& own = at(slot);
    const TrialLanes& group = lanes_->groupOf(own.handle);
    const int lane = lanes_->laneOf(own.handle);
    const TrackMotion track(group, lane);
    const ContactList& found = group.found[static_cast<std::size_t>(lane)];
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& f = found[i].values;
        const Vec3 arm = track.toRoom({f[kArmX], f[kArmY], f[kArmZ]});
        // Floats keep a unit vector to 1e-7.
        const Vec3 normal = track.toRoom({f[kNormalX], f[kNormalY], f[kNormalZ]}).normalized();
        contacts_.push_back({arm, normal, f[kGap], track.velocity(track.now, arm),
                             track.velocity(track.before, arm), found[i].feature, trial::kTrack, slot});
    }
    // What its lane knows of the step before, whoever solved it.
    const WarmStartCache& known = group.warmStarts[static_cast<std::size_t>(lane)];
    for (int i = 0; i < known.count; ++i)
        solver_.memory().push_back({trial::kTrack,
                                    slot,
                                    known.feature[i],
                                    known.normal[i],
                                    {known.along[i], known.across[i]},
                                    known.slid[i]});
}

void StreamTrial::takeResult(int slot, const contact::StepResult& result) {
    const Slot& own = at(slot);
    TrialLanes& group = lanes_->groupOf(own.handle);
    const int lane = lanes_->laneOf(own.handle);
    setThree(group, kAfterX, lane, result.motion.velocity);
    setThree(group, kAfterSpinX, lane, result.motion.angularVelocity);
    setThree(group, kAdvanceX, lane, result.advance.velocity);
    setThree(group, kAdvanceSpinX, lane, result.advance.angularVelocity);
    WarmStartCache& known = group.warmStarts[static_cast<std::size_t>(lane)];
    known.count = 0;
    known.carrying = result.carrying;
}

void StreamTrial::solveIslands() {
    if (partContacts_.empty()) {
        solver_.release();
        return;
    }
    contacts_.clear();
    for (int slot = 0; slot < static_cast<int>(slots_.size()); ++slot) {
        const Slot& own = at(slot);
        if (!own.touched) continue;
        const StreamPart& kind = lanes_->kindOf(own.handle);
        const TrialLanes& group = lanes_->groupOf(own.handle);
        const int lane = lanes_->laneOf(own.handle);
        const base::Mat3 rotation = own.pose.rotation.toRotationMatrix();
        bodies_[static_cast<std::size_t>(slot)] = {
            {kind.inverseMass, rotation * kind.inverseInertia * rotation.transpose()},
            motion(group, kVelocityX, kSpinX, lane),
            motion(group, kAfterX, kAfterSpinX, lane)};
        addTrackContacts(slot);
    }
    for (const contact::PartContact& found : partContacts_)
        contacts_.push_back(
            contact::describe(found.contact, at(found.contact.bodyA).pose, at(found.contact.bodyB).pose));
    const auto results = solver_.solve(bodies_, contacts_, laws_, dt_);
    for (int slot = 0; slot < static_cast<int>(slots_.size()); ++slot)
        if (at(slot).touched) takeResult(slot, results[static_cast<std::size_t>(slot)]);
    // What was between a part and the track is its lane's to know: in the next step it may be alone.
    std::erase_if(solver_.memory(), [&](const contact::ImpulseSolver::Remembered& given) {
        if (given.bodyA != trial::kTrack) return false;
        const int handle = at(given.bodyB).handle;
        WarmStartCache& known =
            lanes_->groupOf(handle).warmStarts[static_cast<std::size_t>(lanes_->laneOf(handle))];
        const int i = known.count++;
        known.feature[i] = given.feature;
        known.normal[i] = static_cast<float>(given.normal);
        known.along[i] = static_cast<float>(given.tangential.x);
        known.across[i] = static_cast<float>(given.tangential.y);
        known.slid[i] = given.sliding;
        return true;
    });
}

trial::TrajectorySample StreamTrial::sample() const {
    trial::TrajectorySample sample;
    sample.time = time();
    sample.drive = drive_.displacement(sample.time);
    for (int slot = 0; slot < static_cast<int>(slots_.size()); ++slot) {
        if (!at(slot).taken) continue;
        const TrialLanes& group = lanes_->groupOf(at(slot).handle);
        const int lane = lanes_->laneOf(at(slot).handle);
        sample.parts.push_back(describeState(group, lane, traffic_.progress(), *traffic_.partOf(slot)));
    }
    std::ranges::sort(sample.parts, {}, &trial::PartState::part);
    return sample;
}

void StreamTrial::rememberPlaces() {
    for (Slot& slot : slots_)
        if (slot.taken)
            slot.centre = lanes_->groupOf(slot.handle).poseInTrack(lanes_->laneOf(slot.handle)).position;
}

std::vector<trial::ContactForce> StreamTrial::forces() const {
    const contact::TrackPlacement placement = drive_.placement(time());
    const auto nameOf = [&](trial::Body slot) {
        return slot == trial::kTrack ? trial::kTrack : static_cast<trial::Body>(*traffic_.partOf(slot));
    };
    std::vector<trial::ContactForce> forces;
    for (int slot = 0; slot < static_cast<int>(slots_.size()); ++slot) {
        const Slot& own = at(slot);
        if (!own.taken || own.touched) continue;
        const double rate = 1.0 / (lanes_->kindOf(own.handle).inverseMass * dt_);
        for (const RecordedImpulse& given : lanes_->recordedOf(own.handle)) {
            if (given.lane != lanes_->laneOf(own.handle)) continue;
            forces.push_back({trial::kTrack, nameOf(slot), own.centre + given.arm,
                              rate * placement.turnBack(given.impulse)});
        }
    }
    if (partContacts_.empty()) return forces;
    for (const contact::ContactImpulse& given : solver_.impulses()) {
        const contact::MovingContact& contact = contacts_[static_cast<std::size_t>(given.contact)];
        forces.push_back({nameOf(contact.bodyA), nameOf(contact.bodyB),
                          at(contact.bodyB).centre + placement.turnBack(contact.arm),
                          placement.turnBack(given.impulse) / dt_});
    }
    return forces;
}

}  // namespace trapwright::native
