#include "core/study/orientation_shares.h"

#include <algorithm>
#include <cmath>

#include "core/part/stable_poses.h"
#include "core/trial/fitness.h"

namespace trapwright::study {

namespace {

constexpr double kAlikeAngle = 3.0 * base::kDegree;  // a symmetry that was found is not exact

/// The part's side that a pose has below. [unit]
base::Vec3 downOf(const part::StablePose& pose) {
    return pose.rotation.inverse() * -base::Vec3::UnitZ();
}

double angleBetween(const base::Vec3& a, const base::Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Whether the part's symmetry maps one pose onto the other, headings apart.
bool areAlike(const part::StablePose& a, const part::StablePose& b, const part::SymmetryGroup& symmetry) {
    if (symmetry.sphere) return true;
    const base::Vec3 first = downOf(a);
    const base::Vec3 second = downOf(b);
    if (symmetry.continuous) {
        const double tiltA = angleBetween(first, symmetry.axis);
        const double tiltB = angleBetween(second, symmetry.axis);
        return std::abs(tiltA - tiltB) < kAlikeAngle ||
               (symmetry.flip && std::abs(tiltA + tiltB - base::kPi) < kAlikeAngle);
    }
    return std::any_of(symmetry.rotations.begin(), symmetry.rotations.end(),
                       [&](const base::Quaternion& rotation) {
                           return angleBetween(first, rotation * second) < kAlikeAngle;
                       });
}

/// A share for each kind of pose, empty.
std::vector<PoseShare> groupPoses(const part::Part& part) {
    std::vector<PoseShare> groups;
    for (std::size_t i = 0; i < part.stablePoses.size(); ++i) {
        const auto found = std::find_if(groups.begin(), groups.end(), [&](const PoseShare& group) {
            return areAlike(part.stablePoses[static_cast<std::size_t>(group.poses.front())],
                            part.stablePoses[i], part.symmetry);
        });
        if (found == groups.end()) {
            groups.push_back({{static_cast<int>(i)}, 0, 0});
        } else {
            found->poses.push_back(static_cast<int>(i));
        }
    }
    return groups;
}

}  // namespace

OrientationShares calcOrientationShares(const part::Part& part, std::span<const trial::Outcome> outcomes,
                                        const base::Quaternion& expected) {
    OrientationShares shares;
    shares.poses = groupPoses(part);
    const auto count = [&](const base::Quaternion& rotation, int PoseShare::*number,
                           std::vector<double>& angles) {
        const int pose = static_cast<int>(part::findStablePose(part, rotation).index);
        for (PoseShare& group : shares.poses)
            if (std::find(group.poses.begin(), group.poses.end(), pose) != group.poses.end())
                ++(group.*number);
        angles.push_back(trial::calcOrientationAngle(rotation, expected, part.symmetry,
                                                     trial::OrientationDistance::symmetric));
    };
    for (const trial::Outcome& outcome : outcomes) {
        count(outcome.initial.rotation, &PoseShare::start, shares.startAngles);
        if (outcome.ending == trial::Ending::finished)
            count(outcome.farthest.rotation, &PoseShare::finish, shares.finishAngles);
    }
    std::sort(shares.startAngles.begin(), shares.startAngles.end());
    std::sort(shares.finishAngles.begin(), shares.finishAngles.end());
    return shares;
}

}  // namespace trapwright::study
