#pragma once

#include <optional>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// The points with normal . p = offset; its back is the side normal . p < offset.
struct Plane {
    base::Vec3 normal = base::Vec3::UnitZ();  // unit
    double offset = 0.0;                      // [m]

    [[nodiscard]] double calcHeight(const base::Vec3& point) const { return normal.dot(point) - offset; }
    [[nodiscard]] Plane flipped() const { return {-normal, -offset}; }
};

using Polygon = std::vector<base::Vec3>;

/// A convex region as the polygons around it (of no particular orientation), made to be cut by planes.
struct ConvexCell {
    std::vector<Polygon> faces;

    [[nodiscard]] base::Vec3 calcMiddle() const;
    [[nodiscard]] std::vector<base::Vec3> collectPoints() const;
};

ConvexCell makeCell(const Box& box);

/// The part of the polygon at the back of the plane; corners nearer to the plane than `tolerance` [m] count
/// as on it and belong to both sides. Fewer than 3 points if nothing remains.
Polygon clip(const Polygon& polygon, const Plane& plane, double tolerance);

/// The part of the cell at the back of the plane, none if no corner is farther behind it than `tolerance`
/// [m].
std::optional<ConvexCell> clip(const ConvexCell& cell, const Plane& plane, double tolerance);

}  // namespace trapwright::geometry
