#pragma once

#include "core/traps/trap_kind.h"

namespace trapwright::traps {

/// The ledge of a bowl's spiral beside its upright wall, cut over a length: the classical devices that reject
/// (Boothroyd 2005, chapter 3), of which the planar theory proves that they can single out one orientation
/// of nearly any part (Berretty, Goldberg, Overmars, van der Stappen 2001: balcony, gap, canyon). What lies
/// along the wall does not turn when it moves on, so that a cut carries it or throws it out by where its
/// weight is: on a ledge narrower than the distance of its centre of mass from the wall nothing stays.
///
/// What comes before goes over to the whole ledge, which falls toward its wall as the spiral's does (track::
/// Spiral: inclination, height of the wall), at its lowest point. Then from one cut to another, each given by
/// how far it goes from the ledge's inner edge and from the wall, which it takes along, and back to the whole
/// ledge. A wall that is taken along becomes lower towards there, down to the ledge, and not too thin to be
/// printed: its foot stays beside what is left. Equal cuts narrow it; different ones are an oblique bite;
/// where they leave nothing in common, a gap with oblique edges between two ledges. Nine numbers: length
/// before the cut, how long its beginning is, inner and outer cut there, length, inner and outer cut at the
/// end (the lower half of the ranges of cuts: none), how long the end is, and how much lower the ledge is
/// behind the cut (negative: from its beginning on).
TrapKind ledge();

}  // namespace trapwright::traps
