#pragma once

#include <optional>

#include "core/base/random.h"
#include "core/trial/batch.h"

namespace trapwright::trial {

/// How start poses are drawn. Learning: any orientation (paper, section 3.4). Validation: near one stable
/// pose with any heading (decisions.md#selection-and-success).
struct StartPolicy {
    std::optional<base::Quaternion> nearPose;  // part frame to world, z up; none: uniform on SO(3)
    double tilt = 2.0 * base::kDegree;         // standard deviation of the disturbance of nearPose [rad]
    double lateral = 2e-3;                     // largest sideways offset from the middle of the track [m]
};

/// Draws a trial of one part from `stream`: the drive's phase, and the part at rest, its lowest point 10
/// micrometres above the lead-in at track.start, as close above the surface as it can. On a bowl that climbs
/// it is above what of the mesh's facets stands out of the helix, too: 17 micrometres at 3 degrees and points
/// 15 mm apart. On a spiral it is turned with the ledge, and moved inward as far as it would be in the wall.
TrialSpec drawTrial(const track::Track& track, const part::Part& part, const StartPolicy& policy,
                    const base::StreamKey& stream);

/// PartOutcome::initial of a part that starts so, but for the last bits, which each engine rounds in its own
/// way.
base::Pose startInTrack(const track::Track& track, const PartStart& start);

}  // namespace trapwright::trial
