#include "core/traps/step.h"

#include <algorithm>
#include <cmath>

namespace trapwright::traps {

namespace {

double within(double low, double high, double share) {
    return low + (high - low) * share;
}

std::vector<search::Dimension> dimensionsOf(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    const double most = kMillimetres * 0.5 * parameters.segmentHeight;
    const double steepest = kSteepestTread / base::kDegree;
    return {{"height", "mm", -most, most},
            {"length", "mm", kMillimetres * parameters.minSegmentLength,
             kMillimetres * parameters.maxSegmentLength},
            {"inclination", "deg", -steepest, steepest}};
}

std::vector<track::CrossSection> buildStep(const TrapParameters& parameters,
                                           const track::CrossSection& /*before*/,
                                           std::span<const double> numbers) {
    const double middle = within(0.0, parameters.segmentHeight, numbers[0]);
    const double length = within(parameters.minSegmentLength, parameters.maxSegmentLength, numbers[1]);
    const double slope = -std::tan(within(-kSteepestTread, kSteepestTread, numbers[2]));
    track::CrossSection tread{kStepEdge, {}};
    for (int j = 0; j < parameters.pointsPerSection; ++j) {
        const double y = parameters.segmentWidth * (j / (parameters.pointsPerSection - 1.0) - 0.5);
        tread.points.emplace_back(y, std::clamp(middle + slope * y, 0.0, parameters.segmentHeight));
    }
    return {tread, {kStepEdge + length, tread.points}};
}

std::vector<double> layOutStep(const TrapParameters& parameters) {
    return {kStepEdge, kStepEdge + 0.5 * (parameters.minSegmentLength + parameters.maxSegmentLength)};
}

double longestStep(const TrapParameters& parameters) {
    return kStepEdge + parameters.maxSegmentLength;
}

}  // namespace

TrapKind step() {
    return {"step",
            "Step",
            "A level step: height, length, and how much it is inclined across the track.",
            &dimensionsOf,
            &buildStep,
            &layOutStep,
            &longestStep};
}

}  // namespace trapwright::traps
