#include "core/traps/narrowed.h"

#include <algorithm>
#include <cmath>

namespace trapwright::traps {

namespace {

constexpr double kEdge = 0.5e-3;                        // along the track, of the cut's two ends [m]
constexpr double kMostInclined = 20.0 * base::kDegree;  // across the track
constexpr double kDeepest = 2.0 / 3.0;                  // of the track's width, from either edge
constexpr double kNarrowest = 0.05;                     // what is left of it at least, as a share
constexpr int kBits = 7;

double within(double low, double high, double share) {
    return low + (high - low) * share;
}

std::vector<search::Dimension> dimensionsOf(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    const double deepest = kMillimetres * kDeepest * parameters.segmentWidth;
    const double longest = kMillimetres * parameters.maxSegmentLength;
    const double steepest = kMostInclined / base::kDegree;
    std::vector<search::Dimension> dimensions = {
        {"before, length", "mm", kMillimetres * parameters.minSegmentLength, longest, kBits},
        {"inner cut", "mm", -deepest, deepest, kBits},
        {"outer cut", "mm", -deepest, deepest, kBits},
        {"length", "mm", kMillimetres * kEdge, longest, kBits},
        {"inclination", "deg", -steepest, steepest, kBits}};
    for (const std::size_t relief : {1, 2, 4})
        dimensions[relief].isRelief = true;
    return dimensions;
}

/// The section between these two y, with as many points, as far apart in proportion, inclined.
track::CrossSection shape(const TrapParameters& parameters, const track::CrossSection& whole, double x,
                          double inner, double outer, double slope) {
    const double first = whole.points.front().x();
    const double last = whole.points.back().x();
    track::CrossSection section{x, {}};
    const bool isWhole = inner == first && outer == last;
    for (const base::Vec2& point : whole.points) {
        const double y = isWhole ? point.x() : within(inner, outer, (point.x() - first) / (last - first));
        const double z = isWhole ? point.y() : heightAt(whole, y);
        section.points.emplace_back(y, std::clamp(z + slope * y, 0.0, parameters.segmentHeight));
    }
    return section;
}

std::vector<track::CrossSection> buildNarrowed(const TrapParameters& parameters,
                                               const track::CrossSection& before,
                                               std::span<const double> numbers) {
    const double deepest = kDeepest * parameters.segmentWidth;
    const double inner = before.points.front().x();
    const double outer = before.points.back().x();
    double left = inner + std::max(0.0, within(-deepest, deepest, numbers[1]));
    double right = outer - std::max(0.0, within(-deepest, deepest, numbers[2]));
    // Both cuts meet where nothing would be left.
    const double least = kNarrowest * (outer - inner);
    if (right - left < least) {
        const double middle = std::clamp(0.5 * (left + right), inner + 0.5 * least, outer - 0.5 * least);
        left = middle - 0.5 * least;
        right = middle + 0.5 * least;
    }
    const double slope = -std::tan(within(-kMostInclined, kMostInclined, numbers[4]));
    const double begin = within(parameters.minSegmentLength, parameters.maxSegmentLength, numbers[0]);
    const double end = begin + kEdge + within(kEdge, parameters.maxSegmentLength, numbers[3]);
    return {shape(parameters, before, begin, inner, outer, slope),
            shape(parameters, before, begin + kEdge, left, right, slope),
            shape(parameters, before, end, left, right, slope),
            shape(parameters, before, end + kEdge, inner, outer, slope)};
}

std::vector<double> layOutNarrowed(const TrapParameters& parameters) {
    const double begin = 0.5 * (parameters.minSegmentLength + parameters.maxSegmentLength);
    const double end = begin + kEdge + within(kEdge, parameters.maxSegmentLength, 0.5);
    return {begin, begin + kEdge, end, end + kEdge};
}

double longestNarrowed(const TrapParameters& parameters) {
    return 2.0 * parameters.maxSegmentLength + 2.0 * kEdge;
}

}  // namespace

double heightAt(const track::CrossSection& section, double y) {
    for (std::size_t i = 1; i < section.points.size(); ++i) {
        const base::Vec2& a = section.points[i - 1];
        const base::Vec2& b = section.points[i];
        if (y < std::min(a.x(), b.x()) || y > std::max(a.x(), b.x())) continue;
        if (a.x() == b.x()) return a.y();
        return std::lerp(a.y(), b.y(), (y - a.x()) / (b.x() - a.x()));
    }
    const base::Vec2& first = section.points.front();
    const base::Vec2& last = section.points.back();
    return std::abs(y - first.x()) < std::abs(y - last.x()) ? first.y() : last.y();
}

TrapKind narrowed() {
    return {"narrowed",
            "Narrowed track",
            "What comes before goes on, cut away at its edges: parts without support there fall off.",
            &dimensionsOf,
            &buildNarrowed,
            &layOutNarrowed,
            &longestNarrowed};
}

}  // namespace trapwright::traps
