#include "ui/scene/pose_row.h"

#include <algorithm>
#include <cmath>

namespace trapwright::scene {

namespace {

using base::Vec3;

/// The heading, of 36, in which the pose shows its profile: least deep from front to back.
base::Quaternion facingFront(const part::Part& part, const base::Quaternion& rotation) {
    base::Quaternion best = rotation;
    double least = 1e300;
    for (int i = 0; i < 36; ++i) {
        const base::Quaternion turned = Eigen::AngleAxisd(i * base::kPi / 36.0, Vec3::UnitZ()) * rotation;
        const double depth = boxOf(part, {turned, Vec3::Zero()}).size().y();
        if (depth < least - 1e-9) {
            least = depth;
            best = turned;
        }
    }
    return best;
}

}  // namespace

geometry::Box boxOf(const part::Part& part, const base::Pose& pose) {
    geometry::Box box;
    for (const Vec3& vertex : part.hull.vertices)
        box.include(pose.apply(vertex));
    return box;
}

PoseRow makePoseRow(const part::Part& part) {
    PoseRow row;
    const double gap = 1.1 * part.boundingRadius;
    const double margin = 0.9 * part.boundingRadius;
    std::vector<geometry::Box> boxes;
    double width = -gap;
    double depth = 0.0;
    row.groups = part::findPoseGroups(part);
    for (const part::PoseGroup& group : row.groups) {
        const part::StablePose& stable = part.stablePoses[static_cast<std::size_t>(group.poses.front())];
        row.poses.push_back({facingFront(part, stable.rotation), Vec3::Zero()});
        boxes.push_back(boxOf(part, row.poses.back()));
        width += boxes.back().size().x() + gap;
        depth = std::max(depth, boxes.back().size().y());
    }
    const double labelDepth = 1.3 * part.boundingRadius;
    double left = -0.5 * std::max(width, 0.0);
    row.flat.include({left - margin, -0.5 * depth - margin - labelDepth, 0.0});
    row.flat.include({-left + margin, 0.5 * depth + margin, 0.0});
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Vec3 size = boxes[i].size();
        const Vec3 centre = 0.5 * (boxes[i].low + boxes[i].high);
        row.poses[i].position = {left + 0.5 * size.x() - centre.x(), -centre.y(), -boxes[i].low.z()};
        row.labels.emplace_back(left + 0.5 * size.x(), -0.5 * depth - 0.6 * (margin + labelDepth), 0.0);
        left += size.x() + gap;
    }
    return row;
}

}  // namespace trapwright::scene
