#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/trial/batch.h"
#include "sim/contact/traffic.h"
#include "sim/contact/trial_contact.h"
#include "sim/simbody/free_bodies.h"

namespace trapwright::simbody {

/// What all trials of several parts in one batch share: the track and each kind of part prepared for contact
/// detection.
struct StreamScene {
    explicit StreamScene(const trial::TrialBatch& batch);

    const trial::TrialBatch* batch;
    contact::ContactTrack track;
    std::vector<contact::ContactBody> bodies;  // of each kind of part
};

/// One running trial of several parts, which come and go and touch each other. Each kind of part has a
/// FreeBodies.
class StreamRun {
 public:
    StreamRun(std::shared_ptr<const StreamScene> scene, std::size_t trial, double dt);

    /// Takes the next step. False if the trial is over, and none was taken.
    bool step(trial::CostLaps& laps);
    /// The first part of step(): who ends, who comes. False if the trial is over.
    bool begin();
    /// The rest of it.
    void finish(trial::CostLaps& laps);

    /// The moment at the begin of the coming step; between begin() and finish().
    [[nodiscard]] trial::TrajectorySample sample() const;
    [[nodiscard]] const trial::Outcome& outcome() const { return traffic_.progress().outcome(); }
    [[nodiscard]] double time() const { return static_cast<double>(steps_) * dt_; }

 private:
    /// Bodies of one kind of part; those that nobody is in are free.
    struct Bodies {
        FreeBodies bodies;
        std::vector<bool> taken;
    };
    /// Which body a slot has.
    struct Place {
        std::size_t kind = 0;
        int body = 0;
    };

    /// Who ends, who comes. False if the trial is over; then all are still where they ended.
    bool look();
    void enter(const contact::Traffic::Entry& entry);
    void leave(int slot);
    [[nodiscard]] FreeBodies makeBodies(std::size_t kind, int count) const;
    [[nodiscard]] const FreeBodies& bodiesOf(int slot) const {
        return bodies_[places_[static_cast<std::size_t>(slot)].kind].bodies;
    }
    [[nodiscard]] int bodyOf(int slot) const { return places_[static_cast<std::size_t>(slot)].body; }

    std::shared_ptr<const StreamScene> scene_;
    const trial::TrialSpec* spec_;
    double dt_;
    long steps_ = 0;
    long stepsPerCheck_;
    contact::DriveMotion drive_;
    contact::TrialContact contact_;
    contact::Traffic traffic_;
    std::vector<Bodies> bodies_;  // by kind
    std::vector<Place> places_;   // by slot
    std::vector<contact::SteppedPart> parts_;
    std::vector<int> carrying_;  // by slot
    std::vector<long> since_;    // by slot: the step before which its part came
};

}  // namespace trapwright::simbody
