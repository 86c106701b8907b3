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
    return {radius * std::cos(angle), radius * std::sin(angle), trackPoint.z() + rise(trackPoint.x())};
}

base::Vec3 FeederShape::toTrack(const base::Vec3& roomPoint, double xNear) const {
    if (type == FeederType::linear) return roomPoint;
    const double angle = turn(*this) * std::atan2(roomPoint.y(), roomPoint.x());
    const double turns = std::round((xNear / bowlRadius - angle) / (2.0 * base::kPi));
    const double radius = std::hypot(roomPoint.x(), roomPoint.y());
    const double x = (angle + turns * 2.0 * base::kPi) * bowlRadius;
    return {x, radius - bowlRadius, roomPoint.z() - rise(x)};
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
    if (slope != 0.0) {
        frame.col(0) = std::cos(slope) * conveyingDirection + std::sin(slope) * base::Vec3::UnitZ();
        frame.col(2) = frame.col(0).cross(frame.col(1));
    }
    return frame;
}

double FeederShape::rise(double x) const {
    return type == FeederType::bowl && slope != 0.0 ? x * std::tan(slope) : 0.0;
}

base::Vec3 FeederShape::down() const {
    if (type == FeederType::bowl || slope == 0.0) return {0.0, 0.0, -1.0};
    return {-std::sin(slope), 0.0, -std::cos(slope)};
}

}  // namespace trapwright::track
