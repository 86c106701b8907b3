#pragma once

#include "core/traps/trap_kind.h"

namespace trapwright::traps {

/// The narrowed track, the oldest of the devices that reject (Boothroyd 2005, chapter 3): what comes before
/// goes on with the same cross-section, cut away from either edge for a length. What does not find support
/// for its weight on what is left falls off; what lies as the track before it leaves it goes on undisturbed.
/// So it fits behind a trap that is learned, whose right parts come along one way. Five numbers: length
/// before the cut, how far it is cut from the inner and from the outer edge (the lower half of their ranges:
/// not at all), how long, and how much all of it is inclined across the track.
TrapKind narrowed();

/// A narrowed track that tells by fractions of a millimetre: what comes before goes on with the same
/// cross-section, but of the walls on either side of its lowest point only a lip is left for a length, as
/// high as a number says, or nothing, also of the bottom. What lies with its weight low passes, what leans
/// out or is turned by the slanting ends of the notch goes over the lip. What is left may be higher or lower
/// than what comes before, and so may the track behind it. Ten numbers: length and fall before the notch, the
/// inner and the outer lip (below 0: how far the cut goes beyond the lowest point), how long its beginning
/// is, it itself, and its end, how much it and the track behind it are raised, and how much all of it is
/// inclined across the track. Nothing is cut off at the segment's box but by the inclination: all is raised
/// and lowered as far as there is room.
TrapKind notched();

/// The height of a section at y, on the first of its stretches that has such a y; that of the nearest end
/// beside it. [m]
double heightAt(const track::CrossSection& section, double y);

}  // namespace trapwright::traps
