#pragma once

#include <optional>
#include <span>

#include "core/geometry/triangle_mesh.h"
#include "core/track/track.h"

namespace trapwright::track {

/// What stands beside the surface in every cross-section of a printed track. y in track coordinates; what
/// lies flat is told by its height in the room, what climbs with a bowl's track by that in the track's. [m]
struct PrintOutline {
    double base = 0.0;                    // z of the underside, in the room
    std::optional<double> wallTop;        // z on the track; none: no walls
    double innerSide = 0.0;               // y of the walls' outer faces
    double outerSide = 0.0;               // likewise
    double flangeTop = 0.0;               // z in the room; not above the surface
    std::optional<double> innerFlange{};  // y of its edge; none: no flange at this side
    std::optional<double> outerFlange{};  // likewise
};

/// The surface over these sections, what stands beside it, sides, ends and a flat base as one closed,
/// oriented manifold. Its first triangles are those of the track's surface. Walls stand upright on the
/// surface's borders and reach outward to the sides; flanges begin at the walls, or without walls at the
/// borders.
geometry::TriangleMesh buildOutlined(const FeederShape& shape, std::span<const CrossSection> sections,
                                     const PrintOutline& outline);

}  // namespace trapwright::track
