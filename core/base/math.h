#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace trapwright::base {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kDegree = kPi / 180.0;       // [rad]
inline constexpr double kMillimetre = 1e-3;          // [m]
inline constexpr double kStandardGravity = 9.80665;  // [m/s^2]

/// A length as people read it.
constexpr double inMillimetres(double length) {
    return length / kMillimetre;
}

/// Where a body is in a frame: a point p of the body is at rotation * p + position. [m]
struct Pose {
    Quaternion rotation = Quaternion::Identity();
    Vec3 position = Vec3::Zero();

    [[nodiscard]] Vec3 apply(const Vec3& point) const { return rotation * point + position; }
    friend bool operator==(const Pose& a, const Pose& b) {
        return a.rotation.coeffs() == b.rotation.coeffs() && a.position == b.position;
    }
};

}  // namespace trapwright::base
