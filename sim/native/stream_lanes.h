#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/contact/contact_body.h"
#include "sim/native/packed_body.h"
#include "sim/native/trial_lanes.h"

namespace trapwright::native {

/// One kind of part, prepared for streams.
struct StreamPart {
    StreamPart(const part::Part& part, const base::Vec3& gravity, double step, bool anyBowl);
    StreamPart(const StreamPart&) = delete;
    StreamPart& operator=(const StreamPart&) = delete;

    contact::ContactBody body;
    PackedBody packed;
    LaneModel model;
    double inverseMass;         // [1/kg]
    base::Mat3 inverseInertia;  // in part axes [1/(kg m^2)]
};

/// All kinds of parts that like batches have.
using StreamParts = std::vector<std::unique_ptr<const StreamPart>>;

/// The lanes of a thread's streams: a group for each kind of part, stepped in lock-step. Lanes move when
/// others leave, so whoever puts a part here has a handle.
class StreamLanes {
 public:
    explicit StreamLanes(const StreamParts& kinds);

    /// A part of a trial comes, in step `step` of the trial. Returns its handle.
    int enter(const PackedTrack& track, const trial::TrialBatch& batch, const trial::TrialSpec& spec,
              std::size_t part, long step);
    void leave(int handle);

    [[nodiscard]] const StreamPart& kindOf(int handle) const { return *(*kinds_)[placeOf(handle).kind]; }
    [[nodiscard]] TrialLanes& groupOf(int handle) { return groups_[placeOf(handle).kind].lanes; }
    [[nodiscard]] int laneOf(int handle) const { return placeOf(handle).lane; }
    /// Parts that are there.
    [[nodiscard]] int count() const;

    // The kernel's functions, for all groups.
    void beginStep();
    void findContacts();
    void solveAndMove();

    /// Has the costs told apart.
    void measure(trial::CostLaps& laps);
    /// Keeps what contacts give that are solved for here, from now on: impulses of each kind's lanes.
    void record();
    [[nodiscard]] const std::vector<RecordedImpulse>& recordedOf(int handle) const {
        return groups_[placeOf(handle).kind].recorded;
    }

 private:
    struct Group {
        TrialLanes lanes;
        std::vector<int> handles;  // by lane
        std::vector<RecordedImpulse> recorded;
    };
    struct Place {
        std::size_t kind = 0;
        int lane = 0;
    };
    [[nodiscard]] const Place& placeOf(int handle) const { return places_[static_cast<std::size_t>(handle)]; }

    const StreamParts* kinds_;
    std::vector<Group> groups_;  // by kind
    std::vector<Place> places_;  // by handle
    std::vector<int> free_;      // handles
};

}  // namespace trapwright::native
