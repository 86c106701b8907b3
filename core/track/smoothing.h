#pragma once

#include <span>
#include <vector>

#include "core/base/random.h"

namespace trapwright::track {

/// Surface smoothing (paper, section 3.2; decisions.md#smoothing). `points` are the (y, z) values of a grid
/// [section][point], flat. Every point but the four corners is removed with `probability` and reconstructed
/// from those that persist: on the grid's border by linear interpolation along the border, inside as the mean
/// of the nearest known points before and after it in its section and in its row of equal index, weighted by
/// their inverse distances in indices. So probability 0 returns the values bit for bit, 1 gives the bilinear
/// patch of the four corners, surviving points never move, affine data stay as they are, and values stay in
/// the range of the survivors.
///
/// Made for gene values: in strip encoding y is an affine function of the value and the index, so smoothing
/// values smooths places.
std::vector<double> smoothSurface(std::span<const double> points, int sections, int pointsPerSection,
                                  double probability, base::Random& random);

}  // namespace trapwright::track
