#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/math.h"

namespace trapwright::part {

/// Angle of the rotation that leads from a to b, in [0, pi]. [rad]
double calcAngleBetween(const base::Quaternion& a, const base::Quaternion& b);

/// Whether a group has the rotation to within `tolerance`. [rad]
bool hasRotation(const std::vector<base::Quaternion>& group, const base::Quaternion& rotation,
                 double tolerance);

/// The finite group that a group and one more rotation generate, identity first. Empty if products do not
/// close within 60 elements (the largest group that is not cyclic or dihedral), as with a rotation that does
/// not fit.
std::optional<std::vector<base::Quaternion>> extendGroup(const std::vector<base::Quaternion>& group,
                                                         const base::Quaternion& rotation);

/// Schoenflies name of a finite rotation group: Cn, Dn, T, O or I.
std::string nameGroup(const std::vector<base::Quaternion>& group);

}  // namespace trapwright::part
