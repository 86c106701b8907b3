#pragma once

#include <cstddef>
#include <vector>

#include "core/track/feeder_shape.h"
#include "core/trial/outcome.h"

namespace trapwright::trial {

/// A part's pose in the frame of the track's mesh, which vibrates in the room.
base::Pose poseOnTrack(const TrajectorySample& sample, std::size_t part, const track::FeederShape& shape);

/// A replay as it is seen from the track, by time.
class RecordedMotion {
 public:
    RecordedMotion(const Trajectory& trajectory, const track::FeederShape& shape);

    /// Of the last sample; 0 if there are none. [s]
    [[nodiscard]] double duration() const { return times_.empty() ? 0.0 : times_.back(); }
    [[nodiscard]] std::size_t parts() const { return poses_.size(); }
    /// Part frame to the track's mesh, between the samples before and after; at other times the nearest one.
    [[nodiscard]] base::Pose poseAt(std::size_t part, double time) const;
    /// Those of the last sample that is not later.
    [[nodiscard]] const std::vector<ContactForce>& forcesAt(double time) const;
    /// Where a part's centre of mass comes along, samples that are nearer than `spacing` [m] to the one
    /// before left out.
    [[nodiscard]] std::vector<base::Vec3> path(std::size_t part, double spacing) const;

 private:
    /// The last sample that is not later; the first one before all. There are samples.
    [[nodiscard]] std::size_t indexAt(double time) const;

    std::vector<double> times_;                   // rising [s]
    std::vector<std::vector<base::Pose>> poses_;  // of each part
    std::vector<std::vector<ContactForce>> forces_;
};

}  // namespace trapwright::trial
