#pragma once

#include <vector>

#include "core/base/math.h"
#include "core/geometry/triangle_mesh.h"
#include "core/track/feeder_shape.h"

namespace trapwright::track {

/// Ordered points (y, z) of the surface at x, from the inner to the outer edge. [m]
struct CrossSection {
    double x = 0.0;
    std::vector<base::Vec2> points;
};

/// What keeps parts on the track: upright walls on the surface's borders, a part of the solid that parts meet
/// (decisions.md#walls). Heights above the surface's crest (findCrest) [m]; 0: an edge without a wall.
struct Walls {
    double inner = 0.0;
    double outer = 0.0;

    [[nodiscard]] bool any() const { return inner > 0.0 || outer > 0.0; }
    friend bool operator==(const Walls&, const Walls&) = default;
};

/// What parts come up the bowl on instead of a lead-in that is level over the whole width: a ledge in the
/// middle of the track beside an upright wall at its outer side, to which it is inclined, so that parts come
/// along the wall (Boothroyd 2005, chapter 3; decisions.md#spiral).
struct Spiral {
    double width = 0.0;                        // of the ledge [m]; 0: none, the lead-in is level
    double wall = 10e-3;                       // above the ledge [m]
    double inclination = 5.0 * base::kDegree;  // the ledge falls toward the wall [rad]

    friend bool operator==(const Spiral&, const Spiral&) = default;
};

/// What parts leave by, behind the lead-out: the same cross-section, falling. The finish line is in its
/// middle, and parts are compared as they lie on it (decisions.md#chute).
struct Chute {
    double length = 0.0;                  // along x [m]; 0: none
    double angle = 20.0 * base::kDegree;  // how steeply it falls [rad]

    friend bool operator==(const Chute&, const Chute&) = default;
};

/// How far walls reach beyond the track's width, unless they are printed thicker (PrintOptions). [m]
inline constexpr double kWallThickness = 2e-3;

/// Lead-in, trap and lead-out as one closed, oriented solid. Immutable once built (track_builder.h).
struct Track {
    FeederShape shape;
    std::vector<CrossSection> sections;  // all of them: lead-in's two, the trap's, the lead-out's duplicates
    int firstTrapSection = 1;            // index of the lead-in's end, where the trap begins
    int lastTrapSection = 1;             // index of the last functional section
    geometry::TriangleMesh solid;        // in the room, drive at its mean position [m]
    std::size_t surfaceTriangles = 0;  // the solid's first triangles; the others are walls, sides, ends, base
    double start = 0.0;                // x where parts are placed [m]
    double finish = 0.0;               // x of the finish line [m]
    double width = 0.0;                // of a segment [m]
    double height = 0.0;               // of a segment [m]
    double baseThickness = 0.0;        // of the solid below the lowest place of z = 0 [m]
    Walls walls;

    [[nodiscard]] double begin() const { return sections.front().x; }
    [[nodiscard]] double end() const { return sections.back().x; }
};

/// What its lead-in is: width 0 if it is not a ledge beside a wall as track_builder.h makes it.
Spiral spiralOf(const Track& track);
/// What its last segment is: length 0 if it is part of the lead-out or the trap.
Chute chuteOf(const Track& track);
/// The axes at x in which orientations are compared: FeederShape::tangentFrame, on the chute tilted with it.
base::Mat3 orientationFrame(const Track& track, double x);
/// How far the chute lies below the lead-out at x; 0 before it. [m]
double chuteFall(const Track& track, double x);
/// Whether the surface lies above a point of the room: one that is not below the solid's base is then inside
/// the solid. [m]
bool isBelowSurface(const Track& track, const base::Vec3& roomPoint);

/// Distance from x to the finish line in segments, the first and the last one counted by the fraction that
/// lies between (paper, Eq. 3; decisions.md#distance-and-statistics); 0 at or past the finish. x before the
/// track counts as its beginning. The lead-in counts as one segment; a bowl's interpolated sub-sections
/// (track_solid.h) do not count.
double segmentsToFinish(const Track& track, double x);

}  // namespace trapwright::track
