#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/math.h"
#include "core/trial/contact.h"

namespace trapwright::trial {

enum class Ending { finished, fellOff, stuck, timedOut };

/// "finished", "fell off", "stuck", "timed out".
std::string_view endingName(Ending ending);

/// How one part's run ended. Poses are in track coordinates: position (x, y, z) of FeederShape, rotation in
/// the tangent frame at the part's x (decisions.md#track-frame).
struct PartOutcome {
    Ending ending = Ending::stuck;
    base::Pose initial;   // at the start
    base::Pose farthest;  // when it had come farthest along the track (paper, section 3.4)
    double time = 0.0;    // of the trial, simulated, when it ended [s]
    /// When it was put on the track; none: there was no room for it before the trial was over, and it timed
    /// out without poses. [s]
    std::optional<double> entered = 0.0;
    /// It fell off, but through the surface, as no part does: a fault of the engine. Its centre of mass and
    /// some of its material are inside the track. Not kept in studies, as such a trial is made again
    /// (BackedEngine).
    bool throughSurface = false;

    friend bool operator==(const PartOutcome&, const PartOutcome&) = default;
};

/// A part of a stream stood still for Termination::stuckTime or longer.
struct Stop {
    std::size_t part = 0;  // its place in TrialSpec::parts
    double from = 0.0;     // when it last came on [s]
    double to = 0.0;       // when it did so again, or was gone, or the trial over [s]

    friend bool operator==(const Stop&, const Stop&) = default;
};

/// How one trial ended.
struct Outcome {
    std::vector<PartOutcome> parts;  // in the order of TrialSpec::parts
    std::vector<Stop> stops;         // of a stream, in the order in which they ended

    friend bool operator==(const Outcome&, const Outcome&) = default;
};

/// Whether all its numbers are numbers.
bool isFinite(const base::Pose& pose);
/// The same of the poses of all its parts.
bool isFinite(const Outcome& outcome);

/// Of all trials together.
std::size_t countParts(std::span<const Outcome> outcomes);

/// Whether all bits are the same of what a part ended with; the initial poses are not looked at.
bool endAlike(const PartOutcome& a, const PartOutcome& b);

/// What outcomes come from: of the same trials, the same makers give the same bits.
struct OutcomeMaker {
    std::string program;         // its name and version
    std::string engine;          // Engine::name()
    std::string instructionSet;  // Engine::instructionSet()

    friend bool operator==(const OutcomeMaker&, const OutcomeMaker&) = default;
};

/// "trapwright 0.1.0, native with AVX2".
std::string describe(const OutcomeMaker& maker);

/// The trials of a whole run, and what made them.
struct MadeOutcomes {
    OutcomeMaker maker;
    std::vector<Outcome> outcomes;
};

/// Where a part is, and how it moves.
struct PartState {
    base::Pose room;                                  // part frame to room
    base::Pose track;                                 // as in PartOutcome, relative to the vibrating track
    base::Vec3 velocity = base::Vec3::Zero();         // of the centre of mass in the room [m/s]
    base::Vec3 angularVelocity = base::Vec3::Zero();  // in the room's axes [rad/s]
    int contacts = 0;                                 // that carried an impulse in the step before
    std::size_t part = 0;                             // its place in TrialSpec::parts
};

/// One moment of a replay.
struct TrajectorySample {
    double time = 0.0;                      // [s]
    base::Vec3 drive = base::Vec3::Zero();  // displacement of the track at the bowl radius in (x, y, z) [m]
    std::vector<PartState> parts;           // those on the track, in the order of TrialSpec::parts
    std::vector<ContactForce> forces;  // of all contacts that carried an impulse in the step before, mean
                                       // over that step; if the engine has no steps, now
};

struct Trajectory {
    std::vector<TrajectorySample> samples;
    Outcome outcome;
};

}  // namespace trapwright::trial
