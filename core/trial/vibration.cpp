#include "core/trial/vibration.h"

#include <algorithm>
#include <cmath>

namespace trapwright::trial {

Vibration seenFromTrack(const Vibration& drive, const track::FeederShape& shape) {
    Vibration seen = drive;
    if (shape.type == track::FeederType::bowl) seen.angle -= shape.slope;
    return seen;
}

double calcLongestStep(const Vibration& drive, double stepsPerPeriod) {
    constexpr double kPerSecond = 1e5;
    constexpr double kRounding = 1e-6;  // a share that is a whole number stays one
    return std::max(std::floor(drive.period() / stepsPerPeriod * kPerSecond + kRounding), 1.0) / kPerSecond;
}

double calcThrowNumber(const Vibration& drive, double gravity) {
    const double omega = drive.angularFrequency();
    return drive.halfStroke * omega * omega * std::sin(drive.angle) / gravity;
}

}  // namespace trapwright::trial
