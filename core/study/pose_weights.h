#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/part/part.h"
#include "core/part/stable_poses.h"
#include "core/study/settings.h"

namespace trapwright::study {

/// How often a part lands in each of its stable poses, which is what totals are weighted by. One weight per
/// pose, none negative; they sum to 1. The one place that says so: by part.poseWeights the quasi-static
/// estimates, or the shares of the drops that came to rest in a pose (part.droppedCounts). Without such
/// counts, or with those of another part, the estimates stand in. No trial depends on the weights: learning
/// starts parts uniformly on SO(3), and a validation tries every pose equally often.
std::vector<double> poseWeights(const part::Part& part, const Settings& settings);

/// Which of the two poseWeights() gives.
PoseWeights weightsInForce(const part::Part& part, const Settings& settings);

/// The groups of alike poses, with the joint weight of their poses as probability.
std::vector<part::PoseGroup> weighPoseGroups(const part::Part& part, const Settings& settings);

/// Counts of drops as part.droppedCounts has them: "129, 48, 23".
std::string countsText(const std::vector<int>& counts);
/// None if the text is no such list.
std::optional<std::vector<int>> readCounts(std::string_view text);

}  // namespace trapwright::study
