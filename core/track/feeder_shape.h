#pragma once

#include "core/base/math.h"

namespace trapwright::track {

enum class FeederType { linear, bowl };
enum class Conveying { clockwise, anticlockwise };  // of a bowl, seen from above

/// The steepest that a feeder slopes, either way. [rad]
inline constexpr double kSteepestSlope = 15.0 * base::kDegree;

/// How track coordinates (x along conveying, arc length on a bowl; y toward the outer edge; z up) lie in the
/// room. Linear: the same axes. Bowl: the room's z axis is the bowl's, the track's origin at (radius, 0, 0);
/// x is measured along the level, z upright from the climbing plane of the track.
struct FeederShape {
    FeederType type = FeederType::linear;
    double bowlRadius = 0.175;  // of y = 0 [m]
    Conveying conveying = Conveying::clockwise;
    /// How steeply the track climbs along conveying, at y = 0 of a bowl; below 0 it falls. A linear feeder is
    /// tilted as a whole, so its room is tilted with it and gravity leans there (down()); a bowl's track
    /// climbs as a helix in a room that is upright (decisions.md#slope). [rad]
    double slope = 0.0;

    [[nodiscard]] base::Vec3 toRoom(const base::Vec3& trackPoint) const;
    /// Inverse of toRoom. On a bowl x is in (-pi, pi] * radius about xNear, the x of a point known close.
    [[nodiscard]] base::Vec3 toTrack(const base::Vec3& roomPoint, double xNear) const;
    /// The right-handed tangent frame at x, as columns in the room: conveying direction, third axis
    /// completing (outward on a linear or clockwise feeder, inward on an anticlockwise one), up from the
    /// track. On a bowl that climbs the first and the last are tilted with it. Orientations of parts are
    /// compared in it (decisions.md#track-frame).
    [[nodiscard]] base::Mat3 tangentFrame(double x) const;
    /// How much higher than at x = 0 the track lies in the room; other than 0 only on a bowl that climbs. [m]
    [[nodiscard]] double rise(double x) const;
    /// Where gravity pulls to in the room; a unit vector.
    [[nodiscard]] base::Vec3 down() const;
};

}  // namespace trapwright::track
