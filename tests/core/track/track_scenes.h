#pragma once

#include "core/base/random.h"
#include "core/track/track_builder.h"
#include "core/traps/free_form.h"

namespace trapwright::testing {

/// A trap with every gene value drawn at random.
inline std::vector<track::CrossSection> drawTrap(const traps::TrapParameters& form, std::uint64_t seed) {
    base::Random random({seed, 0, 0, 0, base::Purpose::test});
    std::vector<double> points(2 * static_cast<std::size_t>(form.crossSections * form.pointsPerSection));
    std::vector<double> lengths(static_cast<std::size_t>(form.crossSections));
    for (double& value : points)
        value = random.uniform();
    for (double& value : lengths)
        value = random.uniform();
    return traps::decodeTrap(form, points, lengths);
}

/// slope [rad]
inline track::FeederShape makeBowl(track::Conveying conveying, double slope = 0.0) {
    return {track::FeederType::bowl, 0.175, conveying, slope};
}

/// The same sections on another feeder.
inline track::Track bend(const track::Track& track, const track::FeederShape& shape) {
    track::TrackParameters parameters;
    parameters.shape = shape;
    parameters.segmentWidth = track.width;
    parameters.segmentHeight = track.height;
    parameters.leadInLength = track.sections[1].x - track.begin();
    parameters.baseThickness = track.baseThickness;
    std::vector<track::CrossSection> trap(track.sections.begin() + 2,
                                          track.sections.begin() + track.lastTrapSection + 1);
    for (track::CrossSection& section : trap)
        section.x -= track.sections[1].x;
    parameters.leadOutSegments = static_cast<int>(track.sections.size()) - 1 - track.lastTrapSection;
    return track::buildTrack(parameters, trap).value();
}

}  // namespace trapwright::testing
