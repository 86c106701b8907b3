#pragma once

#include <span>
#include <vector>

#include "core/traps/trap_kind.h"

namespace trapwright::traps {

/// The paper's trap (section 3.1): a surface of hills and valleys through a grid of points, whose sections
/// stand as far apart as they like (section 4.2.1; decisions.md#genes). Numbers: y and z of each point,
/// section by section from the inner to the outer edge, then the length of each segment, 10 bits each.
TrapKind freeForm();

/// From low to low + size. [m]
struct Interval {
    double low = 0.0;
    double size = 0.0;
};

/// Where point j of a section may lie across the track, from the inner edge (y = -width / 2) on.
Interval spanAcross(const TrapParameters& parameters, int point);

/// The functional cross-sections of points and lengths in [0, 1], as many as the parameters say; x is
/// measured from where the trap begins, y in [-width / 2, width / 2], z in [0, height].
std::vector<track::CrossSection> decodeTrap(const TrapParameters& parameters, std::span<const double> points,
                                            std::span<const double> lengths);

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

}  // namespace trapwright::traps
