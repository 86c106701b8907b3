#include "core/track/track_builder.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <utility>

#include "core/track/print_outline.h"

namespace trapwright::track {

namespace {

using base::inMillimetres;

base::Status checkTrap(std::span<const CrossSection> trap) {
    if (trap.empty()) return base::Error{"The trap has no cross-section; it needs at least 1."};
    const std::size_t points = trap.front().points.size();
    if (points < 2) {
        return base::Error{
            fmt::format("The number of points per cross-section is {}; a surface needs at least 2.", points)};
    }
    double previous = 0.0;
    for (std::size_t i = 0; i < trap.size(); ++i) {
        if (trap[i].points.size() != points) {
            return base::Error{
                fmt::format("Cross-section {} has {} points, the first one {}; all need as many.", i + 1,
                            trap[i].points.size(), points)};
        }
        if (!(trap[i].x > previous && std::isfinite(trap[i].x))) {
            return base::Error{
                fmt::format("Cross-section {} is at x = {:g} mm; it must be beyond {:g} mm, where the one "
                            "before it is.",
                            i + 1, inMillimetres(trap[i].x), inMillimetres(previous))};
        }
        previous = trap[i].x;
    }
    return base::success();
}

/// Points over a width about the middle, falling outward by so much along y from a height in the middle.
void addPlane(CrossSection& section, double width, double z, double fall, std::size_t points) {
    for (std::size_t j = 0; j < points; ++j) {
        const double t = static_cast<double>(j) / static_cast<double>(points - 1);
        const double y = (t - 0.5) * width;
        section.points.emplace_back(y, z - fall * y);
    }
}

base::Status checkSpiral(const TrackParameters& parameters) {
    const Spiral& spiral = parameters.spiral;
    if (spiral.width == 0.0) return base::success();
    const double most = parameters.segmentWidth - 2.0 * kSpiralWallWidth;
    if (!(spiral.width > 0.0 && spiral.width <= most)) {
        return base::Error{fmt::format(
            "The spiral is {:g} mm wide; it must be more than 0 and, with room for its wall on the segments, "
            "at most {:g} mm.",
            inMillimetres(spiral.width), inMillimetres(most))};
    }
    if (!(spiral.inclination >= 0.0 && spiral.inclination <= kSteepestSpiral * (1.0 + 1e-12))) {
        return base::Error{fmt::format("The spiral's inclination is {:g} deg; it must be from 0 to {:g} deg.",
                                       spiral.inclination / base::kDegree, kSteepestSpiral / base::kDegree)};
    }
    const double fall = 0.5 * spiral.width * std::tan(spiral.inclination);
    const double room = 0.5 * parameters.segmentHeight;
    if (!(spiral.wall > 0.0 && spiral.wall - fall <= room && fall <= room)) {
        return base::Error{fmt::format(
            "The spiral's wall is {:g} mm high; it must be more than 0, and ledge and wall must keep to the "
            "segment height ({:g} mm), in the middle of which the ledge lies.",
            inMillimetres(spiral.wall), inMillimetres(parameters.segmentHeight))};
    }
    return base::success();
}

base::Status checkChute(const Chute& chute) {
    if (!(chute.length >= 0.0 && std::isfinite(chute.length))) {
        return base::Error{fmt::format("The chute is {:g} mm long; it must be 0 (none) or more.",
                                       inMillimetres(chute.length))};
    }
    if (!(chute.angle > 0.0 && chute.angle <= kSteepestChute * (1.0 + 1e-12))) {
        return base::Error{
            fmt::format("The chute falls by {:g} deg; it must be more than 0 and at most {:g}.",
                        chute.angle / base::kDegree, kSteepestChute / base::kDegree)};
    }
    return base::success();
}

}  // namespace

base::Status checkParameters(const TrackParameters& parameters) {
    const struct {
        const char* name;
        double value;
    } lengths[] = {{"segment width", parameters.segmentWidth},
                   {"segment height", parameters.segmentHeight},
                   {"lead-in length", parameters.leadInLength},
                   {"maximal segment length", parameters.maxSegmentLength},
                   {"base thickness", parameters.baseThickness}};
    for (const auto& [name, value] : lengths) {
        if (!(value > 0.0 && std::isfinite(value))) {
            return base::Error{
                fmt::format("The {} is {:g} mm; it must be greater than 0.", name, inMillimetres(value))};
        }
    }
    if (!(parameters.startFromLeadInEnd >= 0.0 && parameters.startFromLeadInEnd < parameters.leadInLength)) {
        return base::Error{fmt::format(
            "The start's distance from the lead-in's end is {:g} mm; it must be at least 0 and less than the "
            "lead-in "
            "length ({:g} mm).",
            inMillimetres(parameters.startFromLeadInEnd), inMillimetres(parameters.leadInLength))};
    }
    if (parameters.leadOutSegments < 1) {
        return base::Error{
            fmt::format("The number of lead-out segments is {}; the finish line needs at least 1.",
                        parameters.leadOutSegments)};
    }
    if (auto status = checkSpiral(parameters); !status) return status.error();
    if (auto status = checkChute(parameters.chute); !status) return status.error();
    return checkWalls(parameters.walls);
}

CrossSection makeLeadIn(const TrackParameters& parameters, double x, std::size_t points) {
    CrossSection section{x, {}};
    const double middle = 0.5 * parameters.segmentHeight;
    const Spiral& spiral = parameters.spiral;
    if (spiral.width == 0.0) {
        addPlane(section, parameters.segmentWidth, middle, 0.0, points);
        return section;
    }
    addPlane(section, spiral.width, middle, std::tan(spiral.inclination), points - 2);
    const double top = section.points.back().y() + spiral.wall;
    section.points.emplace_back(0.5 * spiral.width + kSpiralWallRun, top);
    section.points.emplace_back(0.5 * spiral.width + kSpiralWallWidth, top);
    return section;
}

base::Status checkWalls(const Walls& walls) {
    constexpr double kHighest = 1.0;  // [m]; what is higher was not meant
    for (const auto& [name, height] : {std::pair("inner wall", walls.inner), {"outer wall", walls.outer}}) {
        if (!(height >= 0.0 && height <= kHighest)) {
            return base::Error{fmt::format("The {} is {:g} mm high; it must be from 0 to {:g} mm.", name,
                                           inMillimetres(height), inMillimetres(kHighest))};
        }
    }
    return base::success();
}

double widthWithWalls(double width, const Walls& walls) {
    return width + (walls.any() ? 2.0 * kWallThickness : 0.0);
}

base::Status checkShape(const FeederShape& shape, double length, double width) {
    // A limit that is told in degrees may be rounded.
    if (!(std::abs(shape.slope) <= kSteepestSlope * (1.0 + 1e-12))) {
        return base::Error{fmt::format("The slope is {:g} deg; it must be from {:g} to {:g} deg.",
                                       shape.slope / base::kDegree, -kSteepestSlope / base::kDegree,
                                       kSteepestSlope / base::kDegree)};
    }
    if (shape.type == FeederType::linear) return base::success();
    if (!(shape.bowlRadius > 0.5 * width && std::isfinite(shape.bowlRadius))) {
        return base::Error{fmt::format(
            "The bowl radius is {:g} mm; it must be greater than half the segment width ({:g} mm).",
            inMillimetres(shape.bowlRadius), inMillimetres(0.5 * width))};
    }
    const double circumference = 2.0 * base::kPi * shape.bowlRadius;
    if (!(length < circumference)) {
        return base::Error{fmt::format(
            "The track is {:.1f} mm long but the bowl's circumference at a bowl radius of {:g} mm is only "
            "{:.1f} mm; use "
            "fewer or shorter segments or a larger bowl.",
            inMillimetres(length), inMillimetres(shape.bowlRadius), inMillimetres(circumference))};
    }
    return base::success();
}

void addSolid(Track& track) {
    TrackSolid solid;
    if (track.walls.any()) {
        PrintOutline outline;
        outline.base = findBase(track.shape, track.sections, track.baseThickness);
        outline.crest = findCrest(track.sections);
        outline.width = track.width;
        outline.outerSide = 0.5 * widthWithWalls(track.width, track.walls);
        outline.innerSide = -outline.outerSide;
        if (track.walls.inner > 0.0) outline.innerWall = track.walls.inner;
        if (track.walls.outer > 0.0) outline.outerWall = track.walls.outer;
        solid = buildOutlined(track.shape, track.sections, outline);
    } else {
        solid = buildTrackSolid(track.shape, track.sections, track.baseThickness);
    }
    track.solid = std::move(solid.mesh);
    track.surfaceTriangles = solid.surfaceTriangles;
}

base::Result<Track> buildTrack(const TrackParameters& parameters, std::span<const CrossSection> trap) {
    if (auto status = checkParameters(parameters); !status) return status.error();
    if (auto status = checkTrap(trap); !status) return status.error();
    const std::size_t points = trap.front().points.size();
    if (parameters.spiral.width > 0.0 && points < kLeastSpiralPoints) {
        return base::Error{fmt::format(
            "The number of points per cross-section is {}; a spiral with its wall needs at least {}.", points,
            kLeastSpiralPoints)};
    }
    const double length = parameters.leadInLength + trap.back().x +
                          parameters.leadOutSegments * parameters.maxSegmentLength + parameters.chute.length;
    if (auto status =
            checkShape(parameters.shape, length, widthWithWalls(parameters.segmentWidth, parameters.walls));
        !status)
        return status.error();

    Track track;
    track.shape = parameters.shape;
    track.width = parameters.segmentWidth;
    track.height = parameters.segmentHeight;
    track.baseThickness = parameters.baseThickness;
    for (const double x : {0.0, parameters.leadInLength})
        track.sections.push_back(makeLeadIn(parameters, x, points));
    track.firstTrapSection = 1;
    for (const CrossSection& section : trap) {
        track.sections.push_back({parameters.leadInLength + section.x, section.points});
    }
    track.lastTrapSection = static_cast<int>(track.sections.size()) - 1;
    for (int i = 0; i < parameters.leadOutSegments; ++i) {
        const CrossSection& before = track.sections.back();
        track.sections.push_back(CrossSection{before.x + parameters.maxSegmentLength, before.points});
    }
    track.start = parameters.leadInLength - parameters.startFromLeadInEnd;
    track.finish = track.end() - 0.5 * parameters.maxSegmentLength;
    if (const Chute& chute = parameters.chute; chute.length > 0.0) {
        CrossSection section = track.sections.back();
        section.x += chute.length;
        for (base::Vec2& point : section.points)
            point.y() -= chute.length * std::tan(chute.angle);
        track.sections.push_back(std::move(section));
        track.finish = track.end() - 0.5 * chute.length;
    }

    track.walls = parameters.walls;
    addSolid(track);
    return track;
}

}  // namespace trapwright::track
