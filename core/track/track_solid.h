#pragma once

#include <span>
#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "core/track/track.h"

namespace trapwright::track {

/// On a bowl no piece of a segment spans more than this angle about the bowl's axis. [rad]
inline constexpr double kLargestBowlStep = 5.0 * base::kDegree;

/// The sections that a solid's mesh is made of: the given ones, and on a bowl as many between as the bend
/// needs, interpolated linearly in track coordinates.
std::vector<CrossSection> subdivideSections(const FeederShape& shape, std::span<const CrossSection> sections);

/// The y of each of the row's base points. Below its surface point where the row is a function of y, so that
/// ends and sides are upright and cross nothing; where it overhangs, evenly from border to border. [m]
std::vector<double> placeBase(const CrossSection& row);

/// z of a solid's flat base in the room: so thick below the lowest place of the track's plane z = 0, and of a
/// chute that falls below it. [m]
double findBase(const FeederShape& shape, std::span<const CrossSection> sections, double baseThickness);

/// A track's solid and how many of its first triangles are its surface.
struct TrackSolid {
    geometry::TriangleMesh mesh;  // in the room [m]
    std::size_t surfaceTriangles = 0;
};

/// Closes the surface over the cross-sections (paper, section 3.1, Figure 2) to a solid with vertical sides,
/// upright ends and a flat base (findBase). With a, b the points j, j + 1 of a section and c, d
/// those of the next, each quad is split into (a, c, b) and (b, c, d), normals up. A bowl's segments are
/// first cut into equal pieces of at most kLargestBowlStep by sections interpolated linearly
/// in track coordinates; each section is then mapped to the room. The mesh is always a closed, oriented
/// manifold; it is free of self-intersections if the sections are functions of y (strip encoding). All
/// sections need the same number of points, at least 2, and increasing x.
TrackSolid buildTrackSolid(const FeederShape& shape, std::span<const CrossSection> sections,
                           double baseThickness);

}  // namespace trapwright::track
