#pragma once

#include <span>
#include <vector>

#include "core/part/part.h"
#include "core/trial/outcome.h"

namespace trapwright::study {

/// Parts that lie in one stable pose, or in one that looks the same because the part is symmetric.
struct PoseShare {
    std::vector<int> poses;  // indices into the part's stable poses, rising
    int start = 0;           // of all parts
    int finish = 0;          // of those that finished
};

/// How parts lie at the start and at the finish of their trials.
struct OrientationShares {
    /// By the stable pose that is nearest; alike poses together, the most probable ones first
    /// (part::findPoseGroups).
    std::vector<PoseShare> poses;
    /// Angles to the expected orientation modulo the part's symmetry, rising. [rad]
    std::vector<double> startAngles;
    std::vector<double> finishAngles;
};

/// Counts the start and final orientations of these trials. The part has stable poses, as buildPart gives
/// them.
OrientationShares calcOrientationShares(const part::Part& part, std::span<const trial::Outcome> outcomes,
                                        const base::Quaternion& expected);

}  // namespace trapwright::study
