#include "core/geometry/convex_cell.h"

#include <algorithm>
#include <cmath>

namespace trapwright::geometry {

namespace {

/// The convex polygon with the given corners, which lie in the plane in any order, some of them several
/// times.
Polygon makeCap(std::vector<base::Vec3> points, const Plane& plane, double tolerance) {
    if (points.size() < 3) return {};
    base::Vec3 middle = base::Vec3::Zero();
    for (const base::Vec3& point : points)
        middle += point;
    middle /= static_cast<double>(points.size());
    const base::Vec3 u = plane.normal.unitOrthogonal();
    const base::Vec3 v = plane.normal.cross(u);
    const auto angle = [&](const base::Vec3& p) { return std::atan2(v.dot(p - middle), u.dot(p - middle)); };
    std::sort(points.begin(), points.end(),
              [&](const base::Vec3& a, const base::Vec3& b) { return angle(a) < angle(b); });
    Polygon cap;
    for (const base::Vec3& point : points)
        if (cap.empty() || (point - cap.back()).norm() > tolerance) cap.push_back(point);
    while (cap.size() > 1 && (cap.front() - cap.back()).norm() <= tolerance)
        cap.pop_back();
    return cap;
}

}  // namespace

base::Vec3 ConvexCell::calcMiddle() const {
    base::Vec3 sum = base::Vec3::Zero();
    double count = 0.0;
    for (const Polygon& face : faces)
        for (const base::Vec3& point : face) {
            sum += point;
            count += 1.0;
        }
    return sum / count;
}

std::vector<base::Vec3> ConvexCell::collectPoints() const {
    std::vector<base::Vec3> points;
    for (const Polygon& face : faces)
        points.insert(points.end(), face.begin(), face.end());
    return points;
}

ConvexCell makeCell(const Box& box) {
    const auto corner = [&](int i) {
        return base::Vec3((i & 1) != 0 ? box.high.x() : box.low.x(),
                          (i & 2) != 0 ? box.high.y() : box.low.y(),
                          (i & 4) != 0 ? box.high.z() : box.low.z());
    };
    ConvexCell cell;
    for (const auto& face :
         {std::array{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}})
        cell.faces.push_back({corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])});
    return cell;
}

Polygon clip(const Polygon& polygon, const Plane& plane, double tolerance) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const base::Vec3& a = polygon[i];
        const base::Vec3& b = polygon[(i + 1) % polygon.size()];
        const double heightA = plane.calcHeight(a);
        const double heightB = plane.calcHeight(b);
        if (heightA <= tolerance) result.push_back(a);
        const bool crosses =
            (heightA < -tolerance && heightB > tolerance) || (heightA > tolerance && heightB < -tolerance);
        if (crosses) result.push_back(a + heightA / (heightA - heightB) * (b - a));
    }
    return result;
}

std::optional<ConvexCell> clip(const ConvexCell& cell, const Plane& plane, double tolerance) {
    bool hasBack = false;
    bool hasFront = false;
    for (const Polygon& face : cell.faces)
        for (const base::Vec3& point : face) {
            const double height = plane.calcHeight(point);
            hasBack = hasBack || height < -tolerance;
            hasFront = hasFront || height > tolerance;
        }
    if (!hasBack) return std::nullopt;
    if (!hasFront) return cell;

    ConvexCell result;
    std::vector<base::Vec3> onPlane;
    for (const Polygon& face : cell.faces) {
        Polygon back = clip(face, plane, tolerance);
        const auto isOn = [&](const base::Vec3& point) {
            return std::abs(plane.calcHeight(point)) <= tolerance;
        };
        std::copy_if(back.begin(), back.end(), std::back_inserter(onPlane), isOn);
        // A face that lies on the plane is replaced by the cap.
        if (back.size() >= 3 && !std::all_of(back.begin(), back.end(), isOn))
            result.faces.push_back(std::move(back));
    }
    Polygon cap = makeCap(std::move(onPlane), plane, tolerance);
    if (cap.size() >= 3) result.faces.push_back(std::move(cap));
    return result;
}

}  // namespace trapwright::geometry
