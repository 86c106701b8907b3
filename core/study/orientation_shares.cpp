#include "core/study/orientation_shares.h"

#include <algorithm>
#include <utility>

#include "core/part/stable_poses.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

OrientationShares calcOrientationShares(const part::Part& part, std::span<const trial::Outcome> outcomes,
                                        const base::Quaternion& expected) {
    OrientationShares shares;
    for (part::PoseGroup& group : part::findPoseGroups(part))
        shares.poses.push_back({std::move(group.poses), 0, 0});
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
        for (const trial::PartOutcome& one : outcome.parts) {
            count(one.initial.rotation, &PoseShare::start, shares.startAngles);
            if (one.ending == trial::Ending::finished)
                count(one.farthest.rotation, &PoseShare::finish, shares.finishAngles);
        }
    }
    std::sort(shares.startAngles.begin(), shares.startAngles.end());
    std::sort(shares.finishAngles.begin(), shares.finishAngles.end());
    return shares;
}

}  // namespace trapwright::study
