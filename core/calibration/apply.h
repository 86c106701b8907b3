#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/calibration/measurement.h"
#include "core/trial/batch.h"
#include "core/trial/vibration.h"

namespace trapwright::calibration {

/// What a simulation has of what is measured: in study::Settings `simulation.contact` and `simulation.drive`.
struct Parameters {
    trial::ContactParameters contact;
    trial::Vibration drive;
};

/// One parameter that would change.
struct Change {
    std::string key;  // of study::Settings: "simulation.contact.staticFriction"
    double before = 0.0;
    Estimate after;  // SI
};

/// What these measurements would change, the newest of each kind. Static friction stands for kinetic as well
/// as long as that is not measured, and kinetic friction is never more than static. Half-stroke is set to
/// what the drive does at `setPoint` (share of full, the one that parts are fed with); it is left alone for
/// 0.
std::vector<Change> findChanges(const Parameters& before, std::span<const Calibration> calibrations,
                                double setPoint);

/// `before` with these changes.
Parameters applyChanges(const Parameters& before, std::span<const Change> changes);

}  // namespace trapwright::calibration
