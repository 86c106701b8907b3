#pragma once

#include <optional>
#include <span>

#include "core/calibration/measurement.h"
#include "core/trial/vibration.h"

namespace trapwright::calibration {

/// What is known of a drive at the moment.
struct DriveState {
    double setPoint = 0.0;                 // share of full
    std::optional<double> frequency;       // [Hz], mechanical
    std::optional<double> halfStroke;      // [m], measured by the drive while it runs
    std::optional<double> fullHalfStroke;  // [m] at full set-point, by its profile
};

/// How a half-stroke is known.
enum class StrokeSource {
    unknown,         // neither measured nor calibrated, and the profile does not tell
    otherFrequency,  // calibrated, but at another frequency
    measured,
    calibrated,
    profile
};

/// What a drive does at its set-point, as far as is known.
struct DriveSetting {
    std::optional<double> halfStroke;  // [m]; none at set-point 0 as well
    StrokeSource source = StrokeSource::unknown;
    std::optional<double> frequency;  // [Hz]
    /// The set-point at which the half-stroke is this one [m], share of full, in proportion; none if the
    /// half-stroke is not known.
    [[nodiscard]] std::optional<double> setPointFor(double wanted) const;

    double setPoint = 0.0;
};

/// The first that is known of: what the drive measures, the newest calibration by conveying speed at this
/// frequency, the profile.
DriveSetting findDriveSetting(const DriveState& state, std::span<const Calibration> calibrations);

/// From here on trials on a drive tell little about a simulation: throw numbers and speeds differ visibly.
inline constexpr double kLargeDeviation = 0.05;

/// One quantity of a drive beside what was simulated.
struct Deviation {
    double drive = 0.0;
    double simulated = 0.0;

    /// 0.1: the drive has 10 % more.
    [[nodiscard]] double share() const { return drive / simulated - 1.0; }
    [[nodiscard]] bool large() const;
};

struct DriveComparison {
    std::optional<Deviation> halfStroke;  // [m]; none: not known of the drive
    std::optional<Deviation> frequency;   // [Hz]; likewise

    [[nodiscard]] bool differs() const;
};

DriveComparison compareDrive(const DriveSetting& setting, const trial::Vibration& simulated);

}  // namespace trapwright::calibration
