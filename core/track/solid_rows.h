#pragma once

#include <span>
#include <vector>

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

}  // namespace trapwright::track
