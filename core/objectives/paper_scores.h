#pragma once

#include <vector>

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// F_C, minus the overlapping triangles (paper, Eq. 2).
Objective collisions();
/// F_D, minus the mean number of segments to the finish (paper, Eq. 3).
Objective distance();
/// F_O, how much more alike the parts lie at the end than at the start (paper, Eq. 4).
Objective orientation();

/// O(x) of Eq. 5, and what each orientation adds to it.
struct Concentration {
    double value = 0.0;  // minus the mean over all pairs of the square root of their distance [sqrt(rad)]
    std::vector<double> means;  // the same of the pairs with one of them; empty for fewer than two
};

/// 0 for fewer than two orientations.
Concentration calcConcentration(std::span<const base::Quaternion> orientations,
                                const part::SymmetryGroup& symmetry, trial::OrientationDistance distance);

/// The F_O that a perfect feeder attains from uniformly random starts, where all parts end indistinguishable.
/// With the symmetric distance: the mean square root of the distance of two random orientations (error <
/// 0.001). With the plain one a symmetric part's ends still differ at random by its symmetry group, which
/// takes that much away (0.137 is left for a cuboid, decisions.md#symmetric-distance; less than 0 for a Dinf
/// part).
double calcBestOrientationScore(const part::SymmetryGroup& symmetry, trial::OrientationDistance distance);

}  // namespace trapwright::objectives
