#include "core/track/print_mount.h"

#include <fmt/format.h>

#include <cmath>

#include "core/track/print_outline.h"

namespace trapwright::track {

namespace {

using base::inMillimetres;

constexpr double kLongest = 1.0;  // [m]; what is larger was not meant

bool hasWalls(const Track& track, const PrintOptions& options) {
    return options.wallHeight > 0.0 || track.walls.any();
}

bool isBowl(const Track& track) {
    return track.shape.type == FeederType::bowl;
}

/// The radius of the circle on which the holes of a bowl's insert lie. [m]
double boltRadius(const Track& track, const PrintOptions& options) {
    return insertRadiusOf(track, options) - options.boltEdgeDistance;
}

/// The flange's length where the bolts are. [m]
double boltLine(const Track& track, const PrintOptions& options) {
    const double length = track.end() - track.begin();
    return isBowl(track) ? length / track.shape.bowlRadius * boltRadius(track, options) : length;
}

PrintProblem tooSmall(const char* option, const char* name, double value, const std::string& bound) {
    return {option, fmt::format("The {} is {:g} mm; it must be {}.", name, inMillimetres(value), bound)};
}

std::optional<PrintProblem> findRangeProblem(const PrintOptions& options, double base) {
    const struct {
        const char* option;
        const char* name;
        double value;
        bool mayBeZero;
    } lengths[] = {{"baseThickness", "base thickness", base, false},
                   {"wallHeight", "wall height", options.wallHeight, true},
                   {"wallThickness", "wall thickness", options.wallThickness, false},
                   {"rim", "rim", options.rim, true},
                   {"flangeThickness", "flange thickness", options.flangeThickness, false},
                   {"boltDiameter", "bolt hole diameter", options.boltDiameter, true},
                   {"boltSpacing", "bolt spacing", options.boltSpacing, false},
                   {"boltEdgeDistance", "bolts' distance from the edge", options.boltEdgeDistance, false},
                   {"insertRadius", "insert radius", options.insertRadius, true}};
    for (const auto& [option, name, value, mayBeZero] : lengths) {
        if (!(mayBeZero ? value >= 0.0 : value > 0.0))
            return tooSmall(option, name, value, mayBeZero ? "at least 0" : "greater than 0");
        if (!(value <= kLongest))
            return tooSmall(option, name, value, fmt::format("at most {:g} mm", inMillimetres(kLongest)));
    }
    return std::nullopt;
}

std::optional<PrintProblem> findBoltProblem(const Track& track, const PrintOptions& options) {
    if (options.boltDiameter == 0.0) return std::nullopt;
    if (!(2.0 * options.boltEdgeDistance > options.boltDiameter)) {
        return tooSmall("boltEdgeDistance", "bolts' distance from the edge", options.boltEdgeDistance,
                        fmt::format("greater than half the holes' diameter of {:g} mm",
                                    inMillimetres(options.boltDiameter)));
    }
    if (!(options.boltSpacing > options.boltDiameter)) {
        return tooSmall(
            "boltSpacing", "bolt spacing", options.boltSpacing,
            fmt::format("greater than the holes' diameter of {:g} mm", inMillimetres(options.boltDiameter)));
    }
    if (2.0 * options.boltEdgeDistance > boltLine(track, options)) {
        return PrintProblem{
            "boltEdgeDistance",
            fmt::format("The bolts' distance from the edge is {:g} mm, but the track is only "
                        "{:g} mm long; it must be at most half of that.",
                        inMillimetres(options.boltEdgeDistance), inMillimetres(boltLine(track, options)))};
    }
    return std::nullopt;
}

}  // namespace

double outerSideOf(const Track& track, const PrintOptions& options) {
    if (hasWalls(track, options)) return 0.5 * track.width + options.wallThickness;
    const bool hasRims = !placeRims(track, options.rim).empty();
    return 0.5 * track.width + (hasRims ? options.rim : 0.0);
}

double flangeWidthOf(const PrintOptions& options) {
    return 2.0 * options.boltEdgeDistance;
}

double insertRadiusOf(const Track& track, const PrintOptions& options) {
    if (options.insertRadius > 0.0) return options.insertRadius;
    return track.shape.bowlRadius + outerSideOf(track, options) + flangeWidthOf(options);
}

std::optional<PrintProblem> findPrintProblem(const Track& track, const PrintOptions& options) {
    const double base = options.baseThickness.value_or(track.baseThickness);
    if (auto problem = findRangeProblem(options, base)) return problem;
    if (isBowl(track) && hasWalls(track, options) &&
        !(outerSideOf(track, options) < track.shape.bowlRadius)) {
        return tooSmall("wallThickness", "wall thickness", options.wallThickness,
                        "less, or the inner wall reaches the bowl's axis");
    }
    if (!options.flange) return std::nullopt;
    if (options.flangeThickness > base) {
        return tooSmall("flangeThickness", "flange thickness", options.flangeThickness,
                        fmt::format("at most the base thickness of {:g} mm, or the flange would rise above "
                                    "the lowest valley",
                                    inMillimetres(base)));
    }
    if (isBowl(track)) {
        PrintOptions least = options;
        least.insertRadius = 0.0;
        if (insertRadiusOf(track, options) < insertRadiusOf(track, least)) {
            return tooSmall("insertRadius", "insert radius", options.insertRadius,
                            fmt::format("at least {:g} mm, to leave room for the track and the bolts, or 0",
                                        inMillimetres(insertRadiusOf(track, least))));
        }
    }
    return findBoltProblem(track, options);
}

std::vector<base::Vec2> placeBolts(const Track& track, const PrintOptions& options) {
    std::vector<base::Vec2> centres;
    if (!options.flange || options.boltDiameter == 0.0) return centres;
    const double line = boltLine(track, options);
    const double free = line - 2.0 * options.boltEdgeDistance;
    const int gaps = static_cast<int>(std::floor(free / options.boltSpacing + 1e-9));
    const double first = 0.5 * (line - gaps * options.boltSpacing);
    std::vector<double> sides;
    if (isBowl(track)) {
        sides = {boltRadius(track, options) - track.shape.bowlRadius};
    } else {
        const double y = outerSideOf(track, options) + options.boltEdgeDistance;
        sides = {-y, y};
    }
    for (const double y : sides) {
        for (int i = 0; i <= gaps; ++i) {
            const double share = (first + i * options.boltSpacing) / line;
            const double x = track.begin() + share * (track.end() - track.begin());
            centres.push_back(track.shape.toRoom({x, y, 0.0}).head<2>());
        }
    }
    return centres;
}

}  // namespace trapwright::track
