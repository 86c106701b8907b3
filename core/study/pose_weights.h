#pragma once

#include <vector>

#include "core/part/part.h"
#include "core/part/stable_poses.h"
#include "core/study/settings.h"

namespace trapwright::study {

/// How often a part lands in each of its stable poses, which is what totals are weighted by. One weight per
/// pose, none negative; they sum to 1. The one place that says so.
std::vector<double> poseWeights(const part::Part& part, const Settings& settings);

/// The groups of alike poses, with the joint weight of their poses as probability.
std::vector<part::PoseGroup> weighPoseGroups(const part::Part& part, const Settings& settings);

}  // namespace trapwright::study
