#pragma once

#include <span>
#include <vector>

#include "core/trial/fitness.h"

namespace trapwright::trial {

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

}  // namespace trapwright::trial
