#pragma once

#include "core/base/math.h"
#include "core/track/feeder_shape.h"

namespace trapwright::trial {

/// The vibration of a feeder: a sinusoid along a line inclined by `angle` to the conveying direction (on a
/// bowl the helical oscillation that has this line at the bowl radius).
struct Vibration {
    double frequency = 50.0;              // mechanical [Hz]
    double halfStroke = 0.8e-3;           // amplitude along the vibration line [m]
    double angle = 12.0 * base::kDegree;  // vibration angle [rad]

    [[nodiscard]] double angularFrequency() const { return 2.0 * base::kPi * frequency; }  // [rad/s]
    [[nodiscard]] double period() const { return 1.0 / frequency; }                        // [s]
};

/// The drive as a part on the track feels it. The vibration of a linear feeder is told from its track and
/// tilted with it; a bowl's is told from the level, so that a track that climbs takes its slope from the
/// angle (Boothroyd 2005, chapter 3; decisions.md#slope).
Vibration seenFromTrack(const Vibration& drive, const track::FeederShape& shape);

/// The longest step of simulated time of which a period of the drive has at least so many. In whole 10 us, as
/// times of outcomes are stored in microseconds, and at least that. [s]
double calcLongestStep(const Vibration& drive, double stepsPerPeriod);

/// Peak vertical acceleration over gravity: half-stroke x omega^2 x sin(angle) / g. Parts lift off above 1.
double calcThrowNumber(const Vibration& drive, double gravity = base::kStandardGravity);

}  // namespace trapwright::trial
