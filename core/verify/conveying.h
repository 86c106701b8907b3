#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/calibration/half_stroke.h"
#include "core/trial/engine.h"

namespace trapwright::verify {

/// How a part moves on a flat track.
struct ConveyingSpeed {
    double mean = 0.0;   // over all headings [m/s]
    double least = 0.0;  // of the headings [m/s]
    double most = 0.0;
};

/// What is vibrated and simulated, and for how long.
struct ConveyingScene {
    std::shared_ptr<const part::Part> part;  // laid in its most probable stable pose
    trial::Vibration drive;                  // told from the track (trial::seenFromTrack)
    trial::ContactParameters contact;
    double slope = 0.0;     // of the track [rad]
    int headings = 4;       // spread evenly over a turn
    double settling = 0.5;  // before speed is measured [s]
    double duration = 2.0;  // in all [s]
};

/// Conveying speed on a flat, linear track, mean over whole periods of the drive. The choice of a
/// half-stroke starts with it. Errors: a part without stable poses, engine, cancelled. Advances `control` by
/// one per heading.
base::Result<ConveyingSpeed> measureConveyingSpeed(const trial::Engine& engine, const ConveyingScene& scene,
                                                   const base::RunControl& control);

/// Conveying speed at half-strokes up to a throw number of 3.3, beyond which parts skip periods, for the
/// calibration of a real drive by its conveying speed. Only what can be inverted (calibration::risingPart).
/// The scene's own half-stroke does not count. Errors and `control` as measureConveyingSpeed.
base::Result<calibration::SpeedTable> measureSpeedTable(const trial::Engine& engine,
                                                        const ConveyingScene& scene,
                                                        const base::RunControl& control);

}  // namespace trapwright::verify
