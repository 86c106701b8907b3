#include "core/verify/predicted_speed.h"

#include "core/verify/hopping.h"
#include "core/verify/stick_slip.h"

namespace trapwright::verify {

ConveyingPrediction predictConveying(const trial::Vibration& drive, const trial::ContactParameters& contact,
                                     double gravity) {
    // Hops need not repeat every period; over this many their mean has settled to a per cent.
    constexpr int kPeriods = 100;
    constexpr double kStandstill = 1e-6;  // [m/s]

    ConveyingPrediction prediction;
    prediction.throwNumber = trial::calcThrowNumber(drive, gravity);
    const bool hops = prediction.throwNumber > 1.0;
    prediction.speed =
        hops ? calcHoppingSpeed(drive, contact.kineticFriction, contact.restitution, gravity, kPeriods)
             : calcStickSlipSpeed(drive, contact.kineticFriction, gravity);
    prediction.conveyance = hops                             ? Conveyance::hops
                            : prediction.speed > kStandstill ? Conveyance::slides
                                                             : Conveyance::sticks;
    return prediction;
}

}  // namespace trapwright::verify
