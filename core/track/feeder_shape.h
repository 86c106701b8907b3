#pragma once

#include "core/base/math.h"

namespace trapwright::track {

enum class FeederType { linear, bowl };
enum class Conveying { clockwise, anticlockwise };  // of a bowl, seen from above

/// How track coordinates (x along conveying, arc length on a bowl; y toward the outer edge; z up) lie in the
/// room. Linear: the same axes. Bowl: the room's z axis is the bowl's, the track's origin at (radius, 0, 0).
struct FeederShape {
    FeederType type = FeederType::linear;
    double bowlRadius = 0.175;  // of y = 0 [m]
    Conveying conveying = Conveying::clockwise;

    [[nodiscard]] base::Vec3 toRoom(const base::Vec3& trackPoint) const;
    /// Inverse of toRoom. On a bowl x is in (-pi, pi] * radius about xNear, the x of a point known close.
    [[nodiscard]] base::Vec3 toTrack(const base::Vec3& roomPoint, double xNear) const;
    /// The right-handed tangent frame at x, as columns in the room: conveying direction, third axis
    /// completing (outward on a linear or clockwise feeder, inward on an anticlockwise one), up. Orientations
    /// of parts are compared in it (decisions.md#track-frame).
    [[nodiscard]] base::Mat3 tangentFrame(double x) const;
};

}  // namespace trapwright::track
