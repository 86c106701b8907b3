#pragma once

#include <span>

#include "core/base/result.h"
#include "core/track/track.h"

namespace trapwright::track {

/// What surrounds the trap, and the box that it keeps to (paper, Table 1 and section 3.1, Figure 3;
/// decisions.md#lead-in-and-lead-out, decisions.md#bowl). The trap's own numbers come to it in
/// traps::TrapParameters, and which traps they are of in study::TrackSettings.
struct TrackParameters {
    FeederShape shape;
    double segmentWidth = 60e-3;      // of the lead-in and of the traps' box [m]
    double segmentHeight = 30e-3;     // of that box; the lead-in lies at half of it [m]
    double maxSegmentLength = 36e-3;  // of a trap's segments, and what the lead-out's have [m]
    double leadInLength = 80e-3;      // [m]
    // The start point's distance before the trap; 60 mm of lead-in stay behind it. [m]
    double startFromLeadInEnd = 20e-3;
    int leadOutSegments = 2;      // duplicates of the last functional section
    double baseThickness = 3e-3;  // of the solid below the lowest place of z = 0 [m]
    Walls walls;
    Spiral spiral;
    Chute chute;
};

inline constexpr double kSteepestSpiral = 45.0 * base::kDegree;
inline constexpr double kSteepestChute = 60.0 * base::kDegree;

/// An error that names the first parameter that is out of its range.
base::Status checkParameters(const TrackParameters& parameters);
base::Status checkWalls(const Walls& walls);

/// From the outer face of the inner wall to that of the outer one, as if there were both or none. [m]
double widthWithWalls(double width, const Walls& walls);

/// The lead-in's cross-section at x: level over the whole width, or the spiral's. [m]
CrossSection makeLeadIn(const TrackParameters& parameters, double x, std::size_t points);
/// The points that a section with a spiral's ledge and wall has at least.
inline constexpr std::size_t kLeastSpiralPoints = 4;
/// How much the wall of a spiral takes beside its ledge. [m]
inline constexpr double kSpiralWallWidth = 2.2e-3;
/// By so much it leans out, so that the surface stays one over y. [m]
inline constexpr double kSpiralWallRun = 0.2e-3;

/// Lead-in from x = 0, the functional sections (x measured from the lead-in's end, at least one), the
/// lead-out and the chute; finish in the middle of the last duplicate or the chute. An error that names the
/// parameter that is out of range, or tells that the track does not fit on the bowl.
base::Result<Track> buildTrack(const TrackParameters& parameters, std::span<const CrossSection> trap);

/// Gives a track its solid, of which all else is known.
void addSolid(Track& track);

/// An error if a track of this length and width, walls included, cannot lie on the feeder: it slopes too
/// steeply, the radius does not exceed half the width, or the length reaches the circumference.
base::Status checkShape(const FeederShape& shape, double length, double width);

}  // namespace trapwright::track
