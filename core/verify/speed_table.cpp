#include "core/verify/speed_table.h"

#include <algorithm>

namespace trapwright::verify {

namespace {

constexpr int kRows = 32;
constexpr double kLongestThrow = 3.3;

/// The half-stroke of a row, from 1.
double halfStrokeOf(int row, trial::Vibration drive, double gravity) {
    drive.halfStroke = 1.0;
    return kLongestThrow / trial::calcThrowNumber(drive, gravity) * row / kRows;
}

}  // namespace

base::Result<calibration::SpeedTable> measureSpeedTable(const trial::Engine& engine,
                                                        const ConveyingScene& scene,
                                                        const base::RunControl& control) {
    constexpr double kFallen = 0.8;  // of the greatest: what follows is not looked at
    calibration::SpeedTable table;
    ConveyingScene row = scene;
    double greatest = 0.0;
    for (int i = 1; i <= kRows; ++i) {
        row.drive.halfStroke = halfStrokeOf(i, scene.drive, base::kStandardGravity);
        const auto speed = measureConveyingSpeed(engine, row, control);
        if (!speed) return speed.error();
        table.halfStrokes.push_back(row.drive.halfStroke);
        table.speeds.push_back(speed->mean);
        greatest = std::max(greatest, speed->mean);
        const double alongTrack = row.drive.halfStroke * row.drive.angularFrequency();
        if (speed->mean < kFallen * greatest && greatest > 0.1 * alongTrack) break;
    }
    return calibration::risingPart(table);
}

}  // namespace trapwright::verify
