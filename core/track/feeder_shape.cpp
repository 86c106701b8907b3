#include "core/track/feeder_shape.h"

#include <cmath>

namespace trapwright::track {

namespace {

// The sense in which the polar angle grows with x.
double turn(const FeederShape& shape) {
    return shape.conveying == Conveying::clockwise ? -1.0 : 1.0;
}

}  // namespace

base::Vec3 FeederShape::toRoom(const base::Vec3& trackPoint) const {
    if (type == FeederType::linear) return trackPoint;
    const double angle = turn(*this) * trackPoint.x() / bowlRadius;
    const double radius = bowlRadius + trackPoint.y();
    return {radius * std::cos(angle), radius * std::sin(angle), trackPoint.z()};
}

base::Vec3 FeederShape::toTrack(const base::Vec3& roomPoint, double xNear) const {
    if (type == FeederType::linear) return roomPoint;
    const double angle = turn(*this) * std::atan2(roomPoint.y(), roomPoint.x());
    const double turns = std::round((xNear / bowlRadius - angle) / (2.0 * base::kPi));
    const double radius = std::hypot(roomPoint.x(), roomPoint.y());
    return {(angle + turns * 2.0 * base::kPi) * bowlRadius, radius - bowlRadius, roomPoint.z()};
}

base::Mat3 FeederShape::tangentFrame(double x) const {
    if (type == FeederType::linear) return base::Mat3::Identity();
    const double sense = turn(*this);
    const double angle = sense * x / bowlRadius;
    const base::Vec3 conveyingDirection = sense * base::Vec3(-std::sin(angle), std::cos(angle), 0.0);
    base::Mat3 frame;
    frame.col(0) = conveyingDirection;
    frame.col(1) = base::Vec3::UnitZ().cross(conveyingDirection);
    frame.col(2) = base::Vec3::UnitZ();
    return frame;
}

}  // namespace trapwright::track
