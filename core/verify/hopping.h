#pragma once

#include "core/trial/vibration.h"

namespace trapwright::verify {

/// Mean conveying speed of a point on a level, vibrating plane under Coulomb friction and Newton's
/// restitution, at any throw number, over `periods` periods after as many to settle. Event-driven: contact
/// and flight in closed form, events by bisection; friction impulse at an impact at most friction times the
/// normal impulse. Restitution falls linearly from the given value at 12 mm/s to 0 at 3 mm/s, as the contact
/// law's does. Shares no code with the engines. [m/s]
double calcHoppingSpeed(const trial::Vibration& drive, double friction, double restitution, double gravity,
                        int periods);

}  // namespace trapwright::verify
