#pragma once

#include "core/trial/vibration.h"

namespace trapwright::verify {

/// Mean conveying speed of a point on a level, vibrating plane under Coulomb friction, for throw numbers
/// below 1, once the motion is periodic. Event-driven: velocities in closed form between events (stick,
/// slip), events by bisection. Shares no code with the engines. [m/s]
double calcStickSlipSpeed(const trial::Vibration& drive, double friction, double gravity);

}  // namespace trapwright::verify
