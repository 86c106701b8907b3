#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/trial/batch.h"
#include "core/trial/termination_monitor.h"

namespace trapwright::contact {

/// Who of the parts of one trial is on the track: each comes at its time, one after the other as the trial
/// lists them, as soon as there is room for it (of those that are there from the begin on nobody asks), and goes when its run has ended. Meanwhile it has a slot;
/// slots are numbered from 0 and used again. For any engine: it tells where parts are every few milliseconds.
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
};

}  // namespace trapwright::contact
