#pragma once

#include <memory>
#include <vector>

#include "core/trial/outcome.h"
#include "sim/contact/drive_motion.h"
#include "sim/contact/impulse_solver.h"
#include "sim/contact/part_pairs.h"
#include "sim/contact/traffic.h"
#include "sim/native/stream_lanes.h"

namespace trapwright::native {

/// One running trial of several parts, which come and go and touch each other. Each has a lane of
/// StreamLanes, which does all for those that touch no other. Those that do are solved for here, in doubles,
/// with the contacts that their lanes found with the track.
///
/// A step: look() of all trials, beginStep() of the lanes, findPartContacts() of the trials, findContacts()
/// of the lanes, solveIslands() of the trials, solveAndMove() of the lanes, endStep() of the trials.
class StreamTrial {
 public:
    StreamTrial(std::shared_ptr<const Scene> scene, std::size_t trial, StreamLanes& lanes, double dt);

    /// Who ends, who comes. False if the trial is over; then all are still where they ended.
    bool look();
    void findPartContacts();
    void solveIslands();
    void endStep() { ++steps_; }
    /// Takes all parts that are still there off the lanes.
    void clear();

    /// Those that are on the track.
    [[nodiscard]] int partCount() const { return present_; }
    [[nodiscard]] double time() const { return static_cast<double>(steps_) * dt_; }
    [[nodiscard]] const trial::Outcome& outcome() const { return traffic_.progress().outcome(); }

    /// The moment at the begin of the coming step, after beginStep() of the lanes; without forces.
    [[nodiscard]] trial::TrajectorySample sample() const;
    /// What the contacts of the coming step will do: to be asked between solveAndMove() of the lanes, which
    /// record, and endStep(), after rememberPlaces() before solveAndMove().
    [[nodiscard]] std::vector<trial::ContactForce> forces() const;
    void rememberPlaces();

 private:
    /// A part that is on the track, as long as it is there.
    struct Slot {
        int handle = 0;
        bool taken = false;
        bool touched = false;                    // by another part in this step
        bool isNear = false;                     // another part
        bool wasNear = false;                    // in the step before
        base::Pose pose;                         // if it is near, part frame to room
        base::Pose lastPose;                     // if it was
        base::Vec3 centre = base::Vec3::Zero();  // in the track's frame, if places are remembered [m]
    };

    void enter(const contact::Traffic::Entry& entry);
    void leave(int slot);
    /// Describes a part that is near another, if it is not described yet.
    void describe(int slot);
    /// Has all parts that others touch solved for here.
    void touchAll();
    void addTrackContacts(int slot);
    void takeResult(int slot, const contact::StepResult& result);
    [[nodiscard]] Slot& at(int slot) { return slots_[static_cast<std::size_t>(slot)]; }
    [[nodiscard]] const Slot& at(int slot) const { return slots_[static_cast<std::size_t>(slot)]; }

    std::shared_ptr<const Scene> scene_;
    const trial::TrialSpec* spec_;
    StreamLanes* lanes_;
    double dt_;
    long steps_ = 0;
    long stepsPerCheck_;
    int present_ = 0;
    bool anyNear_ = false;  // parts to each other, in the last step
    contact::DriveMotion drive_;
    contact::Traffic traffic_;
    contact::ContactLaws laws_;
    contact::PartPairs pairs_;
    contact::ImpulseSolver solver_;
    std::vector<Slot> slots_;
    std::vector<base::Vec3> positions_;         // by slot
    std::vector<contact::NearPart> nearParts_;  // by slot
    std::vector<contact::PartContact> partContacts_;
    std::vector<int> islandOf_;                // by slot: the first one that it touches, also by others
    std::vector<double> pushed_;               // by slot, of that one [m]
    std::vector<contact::MovingBody> bodies_;  // by slot
    std::vector<contact::MovingContact> contacts_;
};

}  // namespace trapwright::native
