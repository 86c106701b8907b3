#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/calibration/measurement.h"
#include "core/trial/batch.h"
#include "core/trial/conditions.h"
#include "core/trial/vibration.h"

namespace trapwright::calibration {

/// What a study has of what is measured: in study::Settings `simulation.contact`, `simulation.drive` and
/// `box`.
struct Parameters {
    trial::ContactParameters contact;
    trial::Vibration drive;
    trial::OperatingBox box{};
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
/// 0. What restitution may be off, and friction where both coefficients are measured, becomes narrower where
/// readings say so, never wider: the 95 % interval of one more reading, which holds the scatter from part to
/// part and the uncertainty of the mean. How far a stroke drifts no single measurement tells.
std::vector<Change> findChanges(const Parameters& before, std::span<const Calibration> calibrations,
                                double setPoint);

/// `before` with these changes.
Parameters applyChanges(const Parameters& before, std::span<const Change> changes);

}  // namespace trapwright::calibration
