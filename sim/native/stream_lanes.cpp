#include "sim/native/stream_lanes.h"

#include "sim/native/kernel.h"

namespace trapwright::native {

namespace {

/// Lanes to begin with.
constexpr int kFewLanes = kWidestVector;

}  // namespace

StreamPart::StreamPart(const part::Part& part, const base::Vec3& gravity, double step, bool anyBowl)
    : body(contact::prepareBody(part.pieces)),
      packed(body),
      model(part, packed, gravity, step, anyBowl),
      inverseMass(1.0 / part.massProperties.mass),
      inverseInertia(part.massProperties.inertia.inverse()) {}

StreamLanes::StreamLanes(const StreamParts& kinds) : kinds_(&kinds) {
    for (const auto& kind : kinds)
        groups_.push_back({TrialLanes(kind->model, kFewLanes), {}, {}});
}

int StreamLanes::enter(const PackedTrack& track, const trial::TrialBatch& batch, const trial::TrialSpec& spec,
                       std::size_t part, long step) {
    const std::size_t kind = spec.parts[part].part;
    Group& group = groups_[kind];
    if (group.lanes.count() == group.lanes.capacity()) group.lanes.grow(2 * group.lanes.capacity());
    group.lanes.add(track, batch, spec, part, step);
    if (free_.empty()) {
        free_.push_back(static_cast<int>(places_.size()));
        places_.emplace_back();
    }
    const int handle = free_.back();
    free_.pop_back();
    places_[static_cast<std::size_t>(handle)] = {kind, group.lanes.count() - 1};
    group.handles.push_back(handle);
    return handle;
}

void StreamLanes::leave(int handle) {
    const Place place = placeOf(handle);
    Group& group = groups_[place.kind];
    group.lanes.remove(place.lane);
    const int moved = group.handles.back();
    group.handles[static_cast<std::size_t>(place.lane)] = moved;
    group.handles.pop_back();
    places_[static_cast<std::size_t>(moved)].lane = place.lane;
    free_.push_back(handle);
}

int StreamLanes::count() const {
    int count = 0;
    for (const Group& group : groups_)
        count += group.lanes.count();
    return count;
}

void StreamLanes::beginStep() {
    for (Group& group : groups_)
        native::beginStep(group.lanes);
}

void StreamLanes::findContacts() {
    for (Group& group : groups_)
        native::findContacts(group.lanes);
}

void StreamLanes::solveAndMove() {
    for (Group& group : groups_) {
        group.recorded.clear();
        native::solveAndMove(group.lanes);
    }
}

void StreamLanes::measure(trial::CostLaps& laps) {
    for (Group& group : groups_)
        group.lanes.laps = &laps;
}

void StreamLanes::record() {
    for (Group& group : groups_)
        group.lanes.recorded = &group.recorded;
}

}  // namespace trapwright::native
