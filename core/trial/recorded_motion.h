#pragma once

#include <cstddef>
#include <vector>

#include "core/track/feeder_shape.h"
#include "core/trial/outcome.h"

namespace trapwright::trial {

/// A part's pose in the frame of the track's mesh, which vibrates in the room. part: in sample.parts.
base::Pose poseOnTrack(const TrajectorySample& sample, std::size_t part, const track::FeederShape& shape);

/// A replay as it is seen from the track, by time.
class RecordedMotion {
 public:
    RecordedMotion(const Trajectory& trajectory, const track::FeederShape& shape);

    /// Of the last sample; 0 if there are none. [s]
    [[nodiscard]] double duration() const { return times_.empty() ? 0.0 : times_.back(); }
    [[nodiscard]] std::size_t parts() const { return parts_.size(); }
    /// Whether a part is on the track: it has come and is not gone, as the last sample tells that is not
    /// later.
    [[nodiscard]] bool isThere(std::size_t part, double time) const;
    /// Part frame to the track's mesh, between the samples before and after; at times at which it is not
    /// there the nearest one, of a part that never comes the identity.
    [[nodiscard]] base::Pose poseAt(std::size_t part, double time) const;
    /// Those of the last sample that is not later.
    [[nodiscard]] const std::vector<ContactForce>& forcesAt(double time) const;
    /// Where a part's centre of mass comes along, samples that are nearer than `spacing` [m] to the one
    /// before left out.
    [[nodiscard]] std::vector<base::Vec3> path(std::size_t part, double spacing) const;

 private:
    /// The last sample that is not later; the first one before all. There are samples.
    [[nodiscard]] std::size_t indexAt(double time) const;

    /// A part's poses while it is there.
    struct Part {
        std::size_t first = 0;  // sample
        std::vector<base::Pose> poses;
    };

    std::vector<double> times_;  // rising [s]
    std::vector<Part> parts_;
    std::vector<std::vector<ContactForce>> forces_;
};

}  // namespace trapwright::trial
