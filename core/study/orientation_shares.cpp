#include "core/study/orientation_shares.h"

#include <algorithm>

#include "core/part/stable_poses.h"
#include "core/trial/fitness.h"

namespace trapwright::study {

OrientationShares calcOrientationShares(const part::Part& part, std::span<const trial::Outcome> outcomes,
                                        const base::Quaternion& expected) {
    OrientationShares shares;
    shares.startPoses.resize(part.stablePoses.size());
    shares.finalPoses.resize(part.stablePoses.size());
    const auto count = [&](const base::Quaternion& rotation, std::vector<int>& poses,
                           std::vector<double>& angles) {
        ++poses[part::findStablePose(part, rotation).index];
        angles.push_back(trial::calcOrientationAngle(rotation, expected, part.symmetry,
                                                     trial::OrientationDistance::symmetric));
    };
    for (const trial::Outcome& outcome : outcomes) {
        count(outcome.initial.rotation, shares.startPoses, shares.startAngles);
        if (outcome.ending == trial::Ending::finished)
            count(outcome.farthest.rotation, shares.finalPoses, shares.finalAngles);
    }
    std::sort(shares.startAngles.begin(), shares.startAngles.end());
    std::sort(shares.finalAngles.begin(), shares.finalAngles.end());
    return shares;
}

}  // namespace trapwright::study
