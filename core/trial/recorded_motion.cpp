#include "core/trial/recorded_motion.h"

#include <algorithm>

namespace trapwright::trial {

base::Pose poseOnTrack(const TrajectorySample& sample, std::size_t part, const track::FeederShape& shape) {
    const base::Pose& room = sample.parts[part].room;
    if (shape.type == track::FeederType::linear) return {room.rotation, room.position - sample.drive};
    // Along the conveying direction a bowl turns.
    const double sense = shape.conveying == track::Conveying::clockwise ? -1.0 : 1.0;
    const base::Quaternion back(
        Eigen::AngleAxisd(-sense * sample.drive.x() / shape.bowlRadius, base::Vec3::UnitZ()));
    return {back * room.rotation, back * room.position - base::Vec3(0.0, 0.0, sample.drive.z())};
}

RecordedMotion::RecordedMotion(const Trajectory& trajectory, const track::FeederShape& shape) {
    times_.reserve(trajectory.samples.size());
    forces_.reserve(trajectory.samples.size());
    parts_.resize(trajectory.outcome.parts.size());
    for (const TrajectorySample& sample : trajectory.samples) {
        for (std::size_t i = 0; i < sample.parts.size(); ++i) {
            Part& part = parts_[sample.parts[i].part];
            if (part.poses.empty()) part.first = times_.size();
            part.poses.push_back(poseOnTrack(sample, i, shape));
        }
        times_.push_back(sample.time);
        forces_.push_back(sample.forces);
    }
}

std::size_t RecordedMotion::indexAt(double time) const {
    const auto later = std::upper_bound(times_.begin(), times_.end(), time);
    return later == times_.begin() ? 0 : static_cast<std::size_t>(later - times_.begin()) - 1;
}

bool RecordedMotion::isThere(std::size_t part, double time) const {
    const Part& own = parts_.at(part);
    const std::size_t sample = indexAt(time);
    return sample >= own.first && sample < own.first + own.poses.size();
}

base::Pose RecordedMotion::poseAt(std::size_t part, double time) const {
    if (part >= parts_.size() || parts_[part].poses.empty()) return {};
    const auto& [first, poses] = parts_[part];
    const std::size_t before = indexAt(time);
    if (before < first) return poses.front();
    const std::size_t own = before - first;
    if (own + 1 >= poses.size()) return poses.back();
    if (time <= times_[before]) return poses[own];
    const double share = (time - times_[before]) / (times_[before + 1] - times_[before]);
    const base::Pose& from = poses[own];
    const base::Pose& to = poses[own + 1];
    return {from.rotation.slerp(share, to.rotation), (1.0 - share) * from.position + share * to.position};
}

const std::vector<ContactForce>& RecordedMotion::forcesAt(double time) const {
    static const std::vector<ContactForce> kNone;
    return times_.empty() ? kNone : forces_[indexAt(time)];
}

std::vector<base::Vec3> RecordedMotion::path(std::size_t part, double spacing) const {
    std::vector<base::Vec3> points;
    for (const base::Pose& pose : parts_[part].poses) {
        if (points.empty() || (pose.position - points.back()).norm() >= spacing)
            points.push_back(pose.position);
    }
    return points;
}

}  // namespace trapwright::trial
