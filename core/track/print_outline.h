#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/track/track.h"
#include "core/track/track_solid.h"

namespace trapwright::track {

/// How far a track's solid goes on level beyond the borders of its surface in a cross-section; 0: not at all.
/// [m]
struct Rims {
    double x = 0.0;  // of the section, along the track
    double inner = 0.0;
    double outer = 0.0;
};

/// Where the surface rises to a border so steeply that it and the upright side below that border are a ridge
/// too sharp to be printed (geometry::kSharpestEdge), a rim of this width; else 0. None at or beside a
/// border that is farther from the track's edge than its point's strip is wide: what is cut off there, to a
/// lip, decides by tenths of a millimetre. No sections if there is no such place.
std::vector<Rims> placeRims(const Track& track, double width);

/// What stands beside the surface in every cross-section of a track: walls that are simulated, and what is
/// printed besides. y in track coordinates; what
/// lies flat is told by its height in the room, what climbs with a bowl's track by that in the track's. [m]
struct PrintOutline {
    double base = 0.0;                    // z of the underside, in the room
    std::vector<base::Vec2> crest{};      // of the whole track (findCrest); walls need it
    std::optional<double> innerWall{};    // how far it rises above the crest; none: no wall at this side
    std::optional<double> outerWall{};    // likewise
    double width = 0.0;                   // of the track (Track::width); 0: walls close all cuts
    double innerSide = 0.0;               // y of the wall's outer face
    double outerSide = 0.0;               // likewise
    double flangeTop = 0.0;               // z in the room; not above the surface
    std::optional<double> innerFlange{};  // y of its edge; none: no flange at this side
    std::optional<double> outerFlange{};  // likewise
    std::vector<Rims> rims{};  // by rising x; between these in proportion, and none where there is a wall
};

/// What walls rise above: (x, z) at each section, nowhere below the surface, falling before and behind what
/// is high by 45 degrees and no more steeply. Between sections in proportion. [m]
std::vector<base::Vec2> findCrest(std::span<const CrossSection> sections);

/// The surface over these sections, what stands beside it, sides, ends and a flat base as one closed,
/// oriented manifold. Its first triangles are those of the track's surface. Walls stand upright on the
/// surface's borders and reach outward to the sides, also where one is cut back; where both are, the surface
/// stands free and has none, and they come down over the segment before. Flanges begin at the walls, or
/// without walls at the rims or borders.
TrackSolid buildOutlined(const FeederShape& shape, std::span<const CrossSection> sections,
                         const PrintOutline& outline);

}  // namespace trapwright::track
