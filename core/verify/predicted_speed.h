#pragma once

#include "core/trial/batch.h"
#include "core/trial/vibration.h"

namespace trapwright::verify {

/// What a drive does to a part that lies flat on a level track.
enum class Conveyance {
    sticks,  // the friction holds it all the time
    slides,  // throw number at most 1
    hops     // above 1
};

struct ConveyingPrediction {
    double throwNumber = 0.0;
    Conveyance conveyance = Conveyance::sticks;
    double speed = 0.0;  // mean [m/s]
};

/// Predicts how quickly a drive conveys before anything is simulated: the event-driven solutions of
/// stick_slip.h and hopping.h for a point, whichever the throw number calls for. Below lift-off restitution
/// plays no part. Some ten milliseconds of work. The drive and the parameters must be in their ranges
/// (study::findProblems).
ConveyingPrediction predictConveying(const trial::Vibration& drive, const trial::ContactParameters& contact,
                                     double gravity);

}  // namespace trapwright::verify
