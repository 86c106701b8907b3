#pragma once

#include <span>
#include <vector>

#include "core/part/part.h"
#include "core/trial/goal.h"
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
    /// Angles to the goal modulo the part's symmetry, rising. [rad]
    std::vector<double> startAngles;
    std::vector<double> finishAngles;
};

/// Counts the start and final orientations of these trials. The part has stable poses, as buildPart gives
/// them.
OrientationShares calcOrientationShares(const part::Part& part, std::span<const trial::Outcome> outcomes,
                                        const trial::Goal& goal);

/// A way in which parts end.
struct EndMode {
    base::Quaternion orientation = base::Quaternion::Identity();  // mean of those that end so
    std::size_t pose = 0;                                         // index of the stable pose that is nearest
    double tilt = 0.0;     // the angle between them; large where parts lean on something [rad]
    double heading = 0.0;  // of the pose as it is listed, about the vertical [rad], -pi to pi
    int count = 0;
};

/// The ways in which those parts end that finish, the most frequent first, until all or `most` are named: the
/// mode (trial::findModalOrientation), then that of the rest, and so on. What is within `tolerance` [rad]
/// ends alike. The part has stable poses. The heading of a part that looks the same in several is one of
/// them; of one with a continuous symmetry about the vertical it says nothing.
std::vector<EndMode> findEndModes(const part::Part& part, std::span<const trial::Outcome> outcomes,
                                  double tolerance, std::size_t most);

}  // namespace trapwright::study
