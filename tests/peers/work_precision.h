#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/trial/engine_registry.h"

namespace trapwright::peers {

/// How right an engine is at one step on motions whose truth is known, and what that costs.
struct PrecisionPoint {
    std::string engine;
    std::string subject;  // "stick-slip", "hopping", "bounce"
    double step = 0.0;    // [s]
    // Relative for speeds, absolute for rebounds; infinite where one motion came to nothing.
    double largestError = 0.0;
    double rmsError = 0.0;
    double cost = 0.0;  // processor time per simulated second of one part, on one thread [s]
};

/// The points of one engine at one step, one for each subject. Errors by replays of single trials; costs by
/// running many of each motion that begin at different phases of the drive, as learning does.
base::Result<std::vector<PrecisionPoint>> measurePrecision(const trial::EngineKind& kind, double step);

/// As text: one line per point.
std::string describePrecision(const std::vector<PrecisionPoint>& points);

/// For each engine the cheapest point whose largest error is below this, and how its cost compares with the
/// first engine's. As text, one line per subject and engine.
std::string compareAtPrecision(const std::vector<PrecisionPoint>& points, double largestError);

/// Writes work-precision.csv and, drawn by gnuplot, work-precision.svg into a folder.
base::Status writePrecisionChart(const std::vector<PrecisionPoint>& points,
                                 const std::filesystem::path& folder);

}  // namespace trapwright::peers
