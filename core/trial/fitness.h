#pragma once

#include <span>

#include "core/part/part.h"
#include "core/track/track.h"
#include "core/trial/outcome.h"

namespace trapwright::trial {

/// The three scores of an evaluation (paper, section 4.1). F = F_C + F_D + F_O.
struct Fitness {
    double collision = 0.0;    // F_C, Eq. 2
    double distance = 0.0;     // F_D, Eq. 3 [segments]
    double orientation = 0.0;  // F_O, Eq. 4 [sqrt(rad)]

    [[nodiscard]] double total() const { return collision + distance + orientation; }
    friend bool operator==(const Fitness&, const Fitness&) = default;
};

/// How far apart two orientations are (decisions.md#symmetric-distance).
enum class OrientationDistance {
    symmetric,  // the least angle over the part's symmetry group; between axes for a continuous one
    plain       // the rotation angle as printed in Eq. 5
};

/// Angle between two orientations of a part in [0, pi]. [rad]
double calcOrientationAngle(const base::Quaternion& a, const base::Quaternion& b,
                            const part::SymmetryGroup& symmetry, OrientationDistance distance);

/// O(x) of Eq. 5: minus the mean over all pairs of the square root of their distance. 0 for fewer than two.
double calcConcentration(std::span<const base::Quaternion> orientations, const part::SymmetryGroup& symmetry,
                         OrientationDistance distance);

/// F_D and F_O of the outcomes of an evaluation; F_C = -overlaps.
Fitness calcFitness(const track::Track& track, std::span<const Outcome> outcomes, int overlaps,
                    const part::SymmetryGroup& symmetry, OrientationDistance distance);

/// The fitness of a track that is not simulated because triangles overlap (decisions.md#overlapping-tracks):
/// F_C = -overlaps, F_D = minus all segments from the start, F_O = -sqrt(pi), below anything that trials can
/// give (all ends half a turn apart, starts alike).
Fitness calcUnsimulatedFitness(const track::Track& track, int overlaps);

/// The F_O that a perfect feeder attains from uniformly random starts, where all parts end indistinguishable.
/// With the symmetric distance: the mean square root of the distance of two random orientations (error <
/// 0.001). With the plain one a symmetric part's ends still differ at random by its symmetry group, which
/// takes that much away (0.137 is left for a cuboid, decisions.md#symmetric-distance; less than 0 for a Dinf
/// part).
double calcBestOrientationScore(const part::SymmetryGroup& symmetry, OrientationDistance distance);

/// The most frequent orientation: the one with the most others within `tolerance` [rad], refined to the mean
/// of those (in the symmetry copy nearest to it). Empty input gives the identity.
base::Quaternion findModalOrientation(std::span<const base::Quaternion> orientations,
                                      const part::SymmetryGroup& symmetry, double tolerance);

}  // namespace trapwright::trial
