#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/math.h"
#include "core/trial/contact_force.h"

namespace trapwright::trial {

enum class Ending { finished, fellOff, stuck, timedOut };

/// "finished", "fell off", "stuck", "timed out".
std::string_view endingName(Ending ending);

/// How one trial ended. Poses are in track coordinates: position (x, y, z) of FeederShape, rotation in the
/// tangent frame at the part's x (decisions.md#track-frame).
struct Outcome {
    Ending ending = Ending::stuck;
    base::Pose initial;   // at the start
    base::Pose farthest;  // when it had come farthest along the track (paper, section 3.4)
    double time = 0.0;    // simulated [s]

    friend bool operator==(const Outcome&, const Outcome&) = default;
};

/// Whether all bits are the same of what a trial ended with; the initial poses are not looked at.
bool endAlike(const Outcome& a, const Outcome& b);

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

/// One moment of a replay. Pose in the room, track displacement and all.
struct TrajectorySample {
    double time = 0.0;                      // [s]
    base::Pose room;                        // part frame to room
    base::Pose track;                       // as in Outcome, relative to the vibrating track
    base::Vec3 drive = base::Vec3::Zero();  // displacement of the track at the bowl radius in (x, y, z) [m]
    base::Vec3 velocity = base::Vec3::Zero();         // of the centre of mass in the room [m/s]
    base::Vec3 angularVelocity = base::Vec3::Zero();  // in the room's axes [rad/s]
    int contacts = 0;                                 // that carried an impulse in the step before
    std::vector<ContactForce> forces;  // of these, mean over that step; if the engine has no steps, now
};

struct Trajectory {
    std::vector<TrajectorySample> samples;
    Outcome outcome;
};

}  // namespace trapwright::trial
