#pragma once

#include "core/trial/batch.h"
#include "core/trial/vibration.h"

namespace trapwright::trial {

/// Mean conveying speed of a point on a vibrating plane under Coulomb friction and Newton's restitution, at
/// any throw number, over `periods` periods after as many to settle. The plane climbs along conveying by
/// `slope` [rad], and the drive's angle is told from it (seenFromTrack). Event-driven: contact and
/// flight in closed form, events by bisection; friction impulse at an impact at most friction times the
/// normal impulse. Restitution falls linearly from the given value at 12 mm/s to 0 at 3 mm/s, as the contact
/// law's does. Shares no code with the engines. [m/s]
double calcHoppingSpeed(const Vibration& drive, double friction, double restitution, double gravity,
                        int periods, double slope = 0.0);

/// Likewise for throw numbers below 1, once the motion is periodic: where friction holds a part that rests
/// (friction above |tan(slope)|). Event-driven: velocities in closed form between events (stick, slip),
/// events by bisection. Shares no code with the engines. [m/s]
double calcStickSlipSpeed(const Vibration& drive, double friction, double gravity, double slope = 0.0);

/// What a drive does to a part that lies flat on the track.
enum class Conveyance {
    sticks,     // the friction holds it all the time
    slides,     // throw number at most 1
    hops,       // above 1
    slidesAway  // the slope is steeper than friction can hold: down, ever quicker
};

struct ConveyingPrediction {
    double throwNumber = 0.0;  // peak acceleration over gravity, both across the track
    Conveyance conveyance = Conveyance::sticks;
    double speed = 0.0;  // mean, below 0 if backwards; 0 of what slides away [m/s]
};

/// Predicts how quickly a drive conveys before anything is simulated: the event-driven solutions of
/// calcStickSlipSpeed and calcHoppingSpeed for a point, whichever the throw number calls for. Below lift-off
/// restitution plays no part. Some ten milliseconds of work. The drive and the parameters must be in their
/// ranges (study::findProblems); slope and the drive's angle as in calcHoppingSpeed.
ConveyingPrediction predictConveying(const Vibration& drive, const ContactParameters& contact, double gravity,
                                     double slope = 0.0);

}  // namespace trapwright::trial
