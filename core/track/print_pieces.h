#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/geometry/bed_fit.h"
#include "core/track/print_solid.h"

namespace trapwright::track {

/// Where a printed track is cut, and what holds its pieces together again. Lengths in metres.
struct SplitOptions {
    std::vector<int> cuts;        // at which sections, ascending, neither the first nor the last; none: whole
    double dowelDiameter = 3e-3;  // of the pins, two in each cut; 0: no holes
    double dowelDepth = 8e-3;     // of a pin in each of the two faces
    double dowelClearance = 0.2e-3;  // holes are wider and deeper than their pins by this
    double dowelWall = 1.2e-3;       // at least, between a hole and the surface

    friend bool operator==(const SplitOptions&, const SplitOptions&) = default;
};

/// A hole for one end of a pin.
struct DowelHole {
    base::Vec3 mouth = base::Vec3::Zero();  // middle of the circle in the cut face, in the room [m]
    base::Vec3 axis = base::Vec3::UnitX();  // into the piece, a unit vector
    double radius = 0.0;                    // of the widest pin that goes in [m]
    double depth = 0.0;                     // [m]
};

/// A part of a track that is printed by itself.
struct PrintPiece {
    SectionRange sections;
    geometry::TriangleMesh solid;  // in its place in the room: closed, manifold, oriented [m]
    std::vector<DowelHole> holes;
};

/// The solid of buildPrintSolid in pieces, along the conveying direction. The volumes of the pieces are those
/// of the whole without the holes. Both holes of a pin lie on one line, across the cut, at least `dowelWall`
/// from the surface, walls and bolt holes; the two pins of a cut are as far apart as they can be. Errors name
/// the option: cuts out of order, no room for the pins, holes of two cuts that meet.
base::Result<std::vector<PrintPiece>, PrintProblem> buildPrintPieces(const Track& track,
                                                                     const PrintOptions& options,
                                                                     const SplitOptions& split);

/// The volume that a hole takes from its piece: a prism that the pin's circle is inside of. [m^3]
double volumeOf(const DowelHole& hole);

/// The outline of the face at which a piece ends: the cut before the next piece. In the room [m]
std::vector<std::vector<base::Vec3>> findCutOutline(const Track& track, const PrintPiece& piece);

/// How far each piece is moved, to be looked at, so that there is this much between them. [m]
std::vector<base::Vec3> layApart(const Track& track, const std::vector<PrintPiece>& pieces, double gap);

/// The cuts with which each piece fits into the printer, turned about the upright axis: as few as can be, at
/// places with room for pins (split.dowel*; split.cuts does not matter) and, where there are others, not
/// through a bolt hole; of those the ones with the shortest longest piece. None if the whole fits. An error
/// if there are none: the track is too high, or a segment alone does not fit.
base::Result<std::vector<int>, PrintProblem> proposeCuts(const Track& track, const PrintOptions& options,
                                                         const SplitOptions& split,
                                                         const geometry::BuildSpace& space);

}  // namespace trapwright::track
