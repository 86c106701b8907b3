#pragma once

#include "core/base/result.h"
#include "core/calibration/half_stroke.h"
#include "core/verify/conveying.h"

namespace trapwright::verify {

/// Conveying speed at half-strokes up to a throw number of 3.3, beyond which parts skip periods, for the
/// calibration of a real drive by its conveying speed. Only what can be inverted (calibration::risingPart).
/// The scene's own half-stroke does not count. Errors and `control` as measureConveyingSpeed.
base::Result<calibration::SpeedTable> measureSpeedTable(const trial::Engine& engine,
                                                        const ConveyingScene& scene,
                                                        const base::RunControl& control);

}  // namespace trapwright::verify
