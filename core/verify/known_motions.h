#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/trial/batch.h"
#include "core/trial/outcome.h"

namespace trapwright::verify {

/// A scene of one trial with a number in it of which the truth is known, in closed form or from an
/// event-driven solution that shares no code with the engines (core/trial/predicted_speed.h).
struct KnownMotion {
    std::string name;
    trial::TrialBatch batch;
    double interval = 0.0;  // of the samples that the number is told from [s]
    double expected = 0.0;
    std::function<double(const trial::Trajectory&)> measure;  // not a number if the trial ended too early
};

/// Speeds of the lying cuboid along a level track, below lift-off. [m/s]
std::vector<KnownMotion> makeStickSlip();
/// The same on a linear feeder tilted by 3 degrees either way, or on a bowl of 50 m radius whose track climbs
/// or falls so, driven at 20 degrees: there the angle to the track is less by the slope. [m/s]
std::vector<KnownMotion> makeClimbing(track::FeederType type);
/// On a level track above lift-off, at half-strokes at which the motion becomes periodic: a chaotic one has
/// no speed to agree on. [m/s]
std::vector<KnownMotion> makeHopping();
/// Below lift-off on level teeth and on lands between slots, 2 mm apart and narrow against the part, which
/// lies on their crests all the time: as on a level track. What is caught at crests is not. [m/s]
std::vector<KnownMotion> makeStickSlipOnCrests();
/// Along and across a track that leans to its side, below lift-off: slipping along it lets the part creep
/// down although friction would hold it. [m/s]
std::vector<KnownMotion> makeCreep();
/// Rebound over impact speed of the cuboid, dropped flat and on a corner in turn. [1]
std::vector<KnownMotion> makeBounces();

}  // namespace trapwright::verify
