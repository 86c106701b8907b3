#include "core/trial/recorded_motion.h"

#include <algorithm>

namespace trapwright::trial {

base::Pose poseOnTrack(const TrajectorySample& sample, const track::FeederShape& shape) {
    if (shape.type == track::FeederType::linear)
        return {sample.room.rotation, sample.room.position - sample.drive};
    // Along the conveying direction a bowl turns.
    const double sense = shape.conveying == track::Conveying::clockwise ? -1.0 : 1.0;
    const base::Quaternion back(
        Eigen::AngleAxisd(-sense * sample.drive.x() / shape.bowlRadius, base::Vec3::UnitZ()));
    return {back * sample.room.rotation,
            back * sample.room.position - base::Vec3(0.0, 0.0, sample.drive.z())};
}

RecordedMotion::RecordedMotion(const Trajectory& trajectory, const track::FeederShape& shape) {
    times_.reserve(trajectory.samples.size());
    poses_.reserve(trajectory.samples.size());
    forces_.reserve(trajectory.samples.size());
    for (const TrajectorySample& sample : trajectory.samples) {
        times_.push_back(sample.time);
        poses_.push_back(poseOnTrack(sample, shape));
        forces_.push_back(sample.forces);
    }
}

std::size_t RecordedMotion::indexAt(double time) const {
    const auto later = std::upper_bound(times_.begin(), times_.end(), time);
    return later == times_.begin() ? 0 : static_cast<std::size_t>(later - times_.begin()) - 1;
}

base::Pose RecordedMotion::poseAt(double time) const {
    if (times_.empty()) return {};
    const std::size_t before = indexAt(time);
    if (before + 1 == times_.size() || time <= times_[before]) return poses_[before];
    const double share = (time - times_[before]) / (times_[before + 1] - times_[before]);
    const base::Pose& from = poses_[before];
    const base::Pose& to = poses_[before + 1];
    return {from.rotation.slerp(share, to.rotation), (1.0 - share) * from.position + share * to.position};
}

const std::vector<ContactForce>& RecordedMotion::forcesAt(double time) const {
    static const std::vector<ContactForce> kNone;
    return times_.empty() ? kNone : forces_[indexAt(time)];
}

std::vector<base::Vec3> RecordedMotion::path(double spacing) const {
    std::vector<base::Vec3> points;
    for (const base::Pose& pose : poses_) {
        if (points.empty() || (pose.position - points.back()).norm() >= spacing)
            points.push_back(pose.position);
    }
    return points;
}

}  // namespace trapwright::trial
