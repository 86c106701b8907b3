#include "core/study/pose_weights.h"

#include <algorithm>
#include <numeric>

namespace trapwright::study {

std::vector<double> poseWeights(const part::Part& part, const Settings&) {
    std::vector<double> weights;
    weights.reserve(part.stablePoses.size());
    for (const part::StablePose& pose : part.stablePoses)
        weights.push_back(std::max(0.0, pose.probability));
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights)
        weight = sum > 0.0 ? weight / sum : 1.0 / static_cast<double>(weights.size());
    return weights;
}

std::vector<part::PoseGroup> weighPoseGroups(const part::Part& part, const Settings& settings) {
    const std::vector<double> weights = poseWeights(part, settings);
    std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
    for (part::PoseGroup& group : groups) {
        group.probability = 0.0;
        for (const int pose : group.poses)
            group.probability += weights[static_cast<std::size_t>(pose)];
    }
    return groups;
}

}  // namespace trapwright::study
