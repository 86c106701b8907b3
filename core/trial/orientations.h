#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/part/part.h"
#include "core/trial/outcome.h"

namespace trapwright::trial {

/// How far apart two orientations are (decisions.md#symmetric-distance).
enum class OrientationDistance {
    symmetric,  // the least angle over the part's symmetry group; between axes for a continuous one
    plain       // the rotation angle as printed in Eq. 5
};

/// Angle between two orientations of a part in [0, pi]. [rad]
double calcOrientationAngle(const base::Quaternion& a, const base::Quaternion& b,
                            const part::SymmetryGroup& symmetry, OrientationDistance distance);

/// The angles between all pairs of a set of orientations, prepared so that a pair costs one dot product per
/// element of the symmetry group and one arc cosine.
class OrientationMetric {
 public:
    OrientationMetric(std::span<const base::Quaternion> orientations, const part::SymmetryGroup& symmetry,
                      OrientationDistance distance);

    /// In [0, pi]; exact to rounding near 0 and pi too. [rad]
    [[nodiscard]] double angle(std::size_t j, std::size_t k) const;

 private:
    enum class Kind { finite, axis, line, nothing };

    Kind kind_ = Kind::finite;
    std::size_t copiesPerOrientation_ = 1;
    std::vector<Eigen::Vector4d> orientations_;  // unit quaternions as vectors
    std::vector<Eigen::Vector4d> copies_;        // those times each group element
    std::vector<base::Vec3> axes_;               // of a continuous group, in the track frame
};

/// The copy of `orientation` under the symmetry group that is nearest to `reference`, with the quaternion
/// sign on its side.
base::Quaternion findNearestCopy(const base::Quaternion& orientation, const base::Quaternion& reference,
                                 const part::SymmetryGroup& symmetry);

/// A rotation by pi about an axis perpendicular to the axis of a continuous group.
base::Quaternion makeFlip(const base::Vec3& axis);

/// What a part's run counts as. One that ran out of time is stuck.
enum class Verdict { success, wrongOrientation, stuck, fellOff };

/// As in files: "success", "wrong-orientation", "stuck", "fell-off".
std::string_view verdictName(Verdict verdict);
std::optional<Verdict> findVerdict(std::string_view name);

/// Parts by what their runs count as.
struct Tally {
    int success = 0;
    int wrongOrientation = 0;
    int stuck = 0;
    int fellOff = 0;

    /// T: all parts; each has a trial of its own.
    [[nodiscard]] int trials() const { return success + failures(); }
    /// F.
    [[nodiscard]] int failures() const { return wrongOrientation + stuck + fellOff; }
    [[nodiscard]] int finished() const { return success + wrongOrientation; }

    void add(Verdict verdict);
    Tally& operator+=(const Tally& other);

    friend bool operator==(const Tally&, const Tally&) = default;
};

/// The orientations in which parts passed the finish line, in the trials' order.
std::vector<base::Quaternion> finalOrientations(std::span<const Outcome> outcomes);

/// The most frequent orientation: the one with the most others within `tolerance` [rad], refined to the mean
/// of those (in the symmetry copy nearest to it). Empty input gives the identity.
base::Quaternion findModalOrientation(std::span<const base::Quaternion> orientations,
                                      const part::SymmetryGroup& symmetry, double tolerance);

}  // namespace trapwright::trial
