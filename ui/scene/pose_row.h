#pragma once

#include <vector>

#include "core/part/stable_poses.h"

namespace trapwright::scene {

/// A part in its stable poses side by side on a flat, one of each group of alike ones, most probable first,
/// left to right as seen from the front (paper, Figure 5). In the room, in metres; the flat lies at z = 0
/// around the origin.
struct PoseRow {
    std::vector<part::PoseGroup> groups;
    std::vector<base::Pose> poses;   // by group: its first stable pose
    std::vector<base::Vec3> labels;  // by group: the place on the flat where its label belongs
    geometry::Box flat;              // of no height: what the flat has to cover
};

PoseRow makePoseRow(const part::Part& part);

/// The box around a part's hull in a pose. [m]
geometry::Box boxOf(const part::Part& part, const base::Pose& pose);

}  // namespace trapwright::scene
