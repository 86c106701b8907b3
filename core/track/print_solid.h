#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/geometry/print_check.h"
#include "core/geometry/triangle_mesh.h"
#include "core/track/track.h"

namespace trapwright::track {

/// What is printed around a track's surface. Lengths in metres.
struct PrintOptions {
    std::optional<double> baseThickness;  // below the lowest place of z = 0; none: as designed
    // Of both side walls, above the surface's crest (findCrest); what the track's own walls are higher
    // counts.
    double wallHeight = 0.0;
    double wallThickness = kWallThickness;  // at least, beyond the track's width
    // Of a rim beyond a border without a wall, where the surface rises to it so steeply that its edge would
    // be too sharp to be printed; 0: none.
    double rim = geometry::PrintLimits().thinnestWall;
    /// To screw the track to a linear feeder: a plate at the foot of both sides. In a bowl: one at the outer
    /// side, cut round at insertRadius.
    bool flange = false;
    double flangeThickness = 3e-3;  // at most the base's
    double boltDiameter = 4.5e-3;   // of the holes, for M4; 0: no holes
    double boltSpacing = 50e-3;     // between their centres, along a linear feeder or the circle of the holes
    double boltEdgeDistance = 8e-3;  // from their centres to the flange's edge; the flange is twice as wide
    double insertRadius = 0.0;       // of the bowl that the insert fits into; 0: the least that leaves room

    friend bool operator==(const PrintOptions&, const PrintOptions&) = default;
};

/// Why there is no such solid.
struct PrintProblem {
    std::string option;   // the field above that is out of range, as "wallThickness"; empty: none of them
    std::string message;  // as in base::Error
};

/// The radius at which a bowl's insert is cut. [m]
double insertRadiusOf(const Track& track, const PrintOptions& options);

/// Sections of a track, by their index, the last one included.
struct SectionRange {
    int first = 0;
    int last = 0;
};

/// The track's solid with what these options add, in the room [m]: closed, oriented, manifold. The triangles
/// of the surface are those of the track, bit for bit. It crosses itself only where the track's surface
/// overhangs.
base::Result<geometry::TriangleMesh, PrintProblem> buildPrintSolid(const Track& track,
                                                                   const PrintOptions& options);

/// What of it lies between two sections: cut there across the conveying direction, on a bowl along a radius.
/// Neighbouring pieces have the same points in their common face, and together they are the whole.
base::Result<geometry::TriangleMesh, PrintProblem> buildPrintSolid(const Track& track,
                                                                   const PrintOptions& options,
                                                                   const SectionRange& range);

}  // namespace trapwright::track
