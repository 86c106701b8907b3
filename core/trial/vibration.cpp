#include "core/trial/vibration.h"

#include <cmath>

namespace trapwright::trial {

double calcThrowNumber(const Vibration& drive, double gravity) {
    const double omega = drive.angularFrequency();
    return drive.halfStroke * omega * omega * std::sin(drive.angle) / gravity;
}

}  // namespace trapwright::trial
