#include "core/study/orientation_shares.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/part/stable_poses.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

OrientationShares calcOrientationShares(const part::Part& part, std::span<const trial::Outcome> outcomes,
                                        const trial::Goal& goal) {
    OrientationShares shares;
    for (part::PoseGroup& group : part::findPoseGroups(part))
        shares.poses.push_back({std::move(group.poses), 0, 0});
    const auto count = [&](const base::Quaternion& rotation, int PoseShare::*number,
                           std::vector<double>& angles) {
        const int pose = static_cast<int>(part::findStablePose(part, rotation).index);
        for (PoseShare& group : shares.poses)
            if (std::find(group.poses.begin(), group.poses.end(), pose) != group.poses.end())
                ++(group.*number);
        angles.push_back(trial::calcAngleToGoal(rotation, goal, part.symmetry));
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

std::vector<EndMode> findEndModes(const part::Part& part, std::span<const trial::Outcome> outcomes,
                                  double tolerance, std::size_t most) {
    std::vector<base::Quaternion> rest = trial::finalOrientations(outcomes);
    std::vector<EndMode> modes;
    while (!rest.empty() && modes.size() < most) {
        EndMode mode;
        mode.orientation = trial::findModalOrientation(rest, part.symmetry, tolerance);
        const std::size_t before = rest.size();
        std::erase_if(rest, [&](const base::Quaternion& end) {
            return trial::calcOrientationAngle(end, mode.orientation, part.symmetry,
                                               trial::OrientationDistance::symmetric) <= tolerance;
        });
        mode.count = static_cast<int>(before - rest.size());
        // The mean of ends that spread widely need not be near any of them.
        if (mode.count == 0) break;
        const part::NearestPose nearest = part::findStablePose(part, mode.orientation);
        mode.pose = nearest.index;
        mode.tilt = nearest.angle;
        const base::Quaternion turn = mode.orientation * part.stablePoses[nearest.index].rotation.conjugate();
        mode.heading = 2.0 * std::atan2(turn.z(), turn.w());
        mode.heading = std::remainder(mode.heading, 2.0 * base::kPi);
        modes.push_back(mode);
    }
    return modes;
}

}  // namespace trapwright::study
