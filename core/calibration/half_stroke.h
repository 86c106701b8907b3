#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/measurement.h"

namespace trapwright::calibration {

/// How quickly a part is conveyed at a half-stroke, by simulation or prediction. Both columns rise.
struct SpeedTable {
    std::vector<double> halfStrokes;  // [m]
    std::vector<double> speeds;       // [m/s]
};

/// The part of a table from where it begins to move up to where its speed first falls: what can be inverted.
/// Rows that are slower than one before by less than 5 % are noise, and left out. Half-strokes must rise.
SpeedTable risingPart(const SpeedTable& table);

/// The half-stroke at a speed, linear between the rows. An error if the table does not reach it, or is empty.
base::Result<double> findHalfStroke(const SpeedTable& table, double speed);

/// What was found at one set-point.
struct SetPointStroke {
    double setPoint = 0.0;  // share of full
    int readings = 0;
    Estimate speed;       // [m/s]
    Estimate halfStroke;  // [m]
};

struct StrokeEstimate {
    std::vector<SetPointStroke> setPoints;  // ascending
    Estimate fullHalfStroke;                // at full set-point [m]
};

/// Half-stroke per set-point from conveying speeds. Each set-point's interval is that of its mean speed (two
/// readings at least), through the table; that of full set-point is Student's over the ratios of half-stroke
/// to set-point, so that a drive that is not proportional shows up as a wide one. What is uncertain in the
/// table itself, as its friction, is in neither. Errors: fewer than three set-points, readings out of range,
/// a speed that the table does not reach.
base::Result<StrokeEstimate> estimateHalfStroke(std::span<const TimedRun> readings, const SpeedTable& table);

}  // namespace trapwright::calibration
