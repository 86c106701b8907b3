#pragma once

#include <functional>
#include <vector>

#include "core/geometry/surface_distance.h"

namespace trapwright::part {

/// How well rotations about the origin map a surface onto itself. Surfaces are compared, not vertex lists:
/// sample points are rotated and their distance to the surface is taken, so that different triangles on like
/// sides do no harm.
class SelfMap {
 public:
    /// `slack` is how far a rotated point may be from the surface [m]; `roundness` is the same as a share of
    /// its distance from the axis, for facets that stand for a circle.
    SelfMap(const geometry::TriangleMesh& mesh, double slack, double roundness);

    /// Whether the rotation maps the surface onto itself within the slack.
    [[nodiscard]] bool maps(const base::Quaternion& rotation) const;
    /// The same for a turned surface: points may be off by the roundness, too.
    [[nodiscard]] bool mapsTurned(const base::Quaternion& rotation, const base::Vec3& axis) const;
    /// Whether any rotation about the axis maps the surface onto itself, up to facets.
    [[nodiscard]] bool isTurned(const base::Vec3& axis) const;
    /// Whether any rotation at all does.
    [[nodiscard]] bool isSphere() const;
    /// The largest distance of a rotated sample from the surface, or the first one found above `limit`. [m]
    [[nodiscard]] double calcDeviation(const base::Quaternion& rotation, double limit) const;

    [[nodiscard]] double slack() const { return slack_; }

 private:
    [[nodiscard]] bool mapsWithin(const base::Quaternion& rotation,
                                  const std::function<double(const base::Vec3&)>& allowed) const;

    geometry::SurfaceDistance surface_;
    std::vector<base::Vec3> samples_;  // farthest from the origin first: they tell a mismatch soonest
    double slack_;
    double roundness_;
};

}  // namespace trapwright::part
