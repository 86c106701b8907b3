#include "core/calibration/drive_setting.h"

#include <cmath>

namespace trapwright::calibration {

namespace {

// A calibration holds for a frequency that differs by no more: near its resonance a feeder's stroke changes
// by several times this share.
constexpr double kSameFrequency = 0.02;
// Of a share, so that 5 % in round numbers is not more than 5 %.
constexpr double kRounding = 1e-9;

const Calibration* findNewestStroke(std::span<const Calibration> calibrations) {
    const Calibration* newest = nullptr;
    for (const Calibration& calibration : calibrations)
        if (calibration.method == Method::conveyingSpeed) newest = &calibration;
    return newest;
}

bool holdsFor(const Calibration& calibration, const std::optional<double>& frequency) {
    return calibration.frequency <= 0.0 || !frequency ||
           std::abs(*frequency - calibration.frequency) <= kSameFrequency * calibration.frequency;
}

}  // namespace

std::optional<double> DriveSetting::setPointFor(double wanted) const {
    if (!halfStroke || *halfStroke <= 0.0) return std::nullopt;
    return setPoint * wanted / *halfStroke;
}

DriveSetting findDriveSetting(const DriveState& state, std::span<const Calibration> calibrations) {
    DriveSetting setting;
    setting.setPoint = state.setPoint;
    setting.frequency = state.frequency;
    const auto set = [&](double halfStroke, StrokeSource source) {
        setting.source = source;
        if (halfStroke > 0.0) setting.halfStroke = halfStroke;
        return setting;
    };
    if (state.halfStroke) return set(*state.halfStroke, StrokeSource::measured);
    if (const Calibration* stroke = findNewestStroke(calibrations)) {
        if (holdsFor(*stroke, state.frequency))
            return set(state.setPoint * stroke->result.value, StrokeSource::calibrated);
        setting.source = StrokeSource::otherFrequency;
        return setting;
    }
    if (state.fullHalfStroke) return set(state.setPoint * *state.fullHalfStroke, StrokeSource::profile);
    return setting;
}

bool Deviation::large() const {
    return std::abs(share()) > kLargeDeviation + kRounding;
}

bool DriveComparison::differs() const {
    return (halfStroke && halfStroke->large()) || (frequency && frequency->large());
}

DriveComparison compareDrive(const DriveSetting& setting, const trial::Vibration& simulated) {
    DriveComparison comparison;
    if (setting.halfStroke && simulated.halfStroke > 0.0)
        comparison.halfStroke = Deviation{*setting.halfStroke, simulated.halfStroke};
    if (setting.frequency && simulated.frequency > 0.0)
        comparison.frequency = Deviation{*setting.frequency, simulated.frequency};
    return comparison;
}

}  // namespace trapwright::calibration
