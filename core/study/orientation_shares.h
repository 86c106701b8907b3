#pragma once

#include <span>
#include <vector>

#include "core/part/part.h"
#include "core/trial/outcome.h"

namespace trapwright::study {

/// How parts lie at the start and at the end of their trials.
struct OrientationShares {
    /// Parts by the stable pose that they are nearest to, slot p for pose p: all at the start, those that
    /// finished at the end.
    std::vector<int> startPoses;
    std::vector<int> finalPoses;
    /// Angles to the expected orientation modulo the part's symmetry, rising. [rad]
    std::vector<double> startAngles;
    std::vector<double> finalAngles;
};

/// Counts the start and final orientations of these trials. The part has stable poses, as buildPart gives
/// them.
OrientationShares calcOrientationShares(const part::Part& part, std::span<const trial::Outcome> outcomes,
                                        const base::Quaternion& expected);

}  // namespace trapwright::study
