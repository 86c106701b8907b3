#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/trial/batch.h"
#include "core/trial/termination_monitor.h"

namespace trapwright::contact {

/// Endings and room for the next part are looked for this often. [s]
inline constexpr double kCheckInterval = 2e-3;

/// Who of the parts of one trial is on the track: each comes at its time, one after the other as the trial
/// lists them, as soon as there is room for it (of those that are there from the begin on nobody asks), and
/// goes when its run has ended. Meanwhile it has a slot; slots are numbered from 0 and used again. For any
/// engine: it tells where parts are every few milliseconds.
class Traffic {
 public:
    Traffic(const trial::TrialBatch& batch, const trial::TrialSpec& spec);

    /// A part that comes, and its slot.
    struct Entry {
        std::size_t part;
        int slot;
    };
    /// The next part, if its time has come and it would touch none that is there; to be asked until there is
    /// none. posesInTrack: part frames to the track's mesh frame, by slot, as slotCount() was.
    std::optional<Entry> admit(double time, std::span<const base::Pose> posesInTrack);

    /// Lets go those whose runs have ended and lets come those whose time it is, at moments kCheckInterval
    /// apart. False if the trial is over; then all are still where they ended. poseOf(slot): part frame to
    /// the track's mesh frame; enter(Entry) puts a part where it starts and returns that pose, leave(slot)
    /// takes it away.
    template <class PoseOf, class Enter, class Leave>
    bool look(double time, const PoseOf& poseOf, const Enter& enter, const Leave& leave);

    /// Whether the run of the part in this slot is over (TerminationMonitor::update); it then has to leave.
    bool hasEnded(int slot, double time, const base::Pose& poseInTrack) {
        return progress_.update(*partOf(slot), time, poseInTrack).has_value();
    }
    /// The slot is free.
    void leave(int slot) { partOf_[static_cast<std::size_t>(slot)].reset(); }

    /// Whether the trial is over, so that outcome() is complete: all have come and gone, or it is a stream
    /// and its time is up, and then those that still wait never came. To be asked after hasEnded of all
    /// slots.
    bool isOver(double time);

    [[nodiscard]] int slotCount() const { return static_cast<int>(partOf_.size()); }
    /// Which part is in a slot; none: it is free.
    [[nodiscard]] std::optional<std::size_t> partOf(int slot) const {
        return partOf_[static_cast<std::size_t>(slot)];
    }
    [[nodiscard]] const trial::TerminationMonitor& progress() const { return progress_; }

 private:
    [[nodiscard]] bool hasRoom(const trial::PartStart& start, std::span<const base::Pose> posesInTrack) const;

    const trial::TrialBatch* batch_;
    const trial::TrialSpec* spec_;
    trial::TerminationMonitor progress_;
    std::size_t next_ = 0;  // to come
    std::vector<std::optional<std::size_t>> partOf_;
    std::vector<base::Pose> posesInTrack_;  // by slot, while looking
    std::vector<int> ended_;                // slots, while looking
};

template <class PoseOf, class Enter, class Leave>
bool Traffic::look(double time, const PoseOf& poseOf, const Enter& enter, const Leave& leave) {
    posesInTrack_.assign(partOf_.size(), {});
    ended_.clear();
    const auto letGo = [&] {
        for (const int slot : ended_) {
            leave(slot);
            partOf_[static_cast<std::size_t>(slot)].reset();
        }
        ended_.clear();
    };
    for (int slot = 0; slot < slotCount(); ++slot) {
        if (!partOf(slot)) continue;
        base::Pose& pose = posesInTrack_[static_cast<std::size_t>(slot)];
        pose = poseOf(slot);
        if (hasEnded(slot, time, pose)) ended_.push_back(slot);
    }
    if (isOver(time)) return false;
    letGo();
    while (const auto entry = admit(time, posesInTrack_)) {
        posesInTrack_.resize(partOf_.size());
        base::Pose& pose = posesInTrack_[static_cast<std::size_t>(entry->slot)];
        pose = enter(*entry);
        // It may begin past the finish; others may touch it already.
        if (hasEnded(entry->slot, time, pose)) ended_.push_back(entry->slot);
    }
    if (isOver(time)) return false;
    letGo();
    return true;
}

}  // namespace trapwright::contact
