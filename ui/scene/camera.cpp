#include "ui/scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trapwright::scene {

namespace {

using base::Vec3;

constexpr double kHomeAzimuth = -64.0 * base::kDegree;
constexpr double kHomeElevation = 38.0 * base::kDegree;
constexpr double kRightAngle = 0.5 * base::kPi;
constexpr double kTurnPerPixel = 0.35 * base::kDegree;
constexpr double kNearest = 2e-3;   // [m]
constexpr double kFarthest = 50.0;  // [m]

/// What an upright camera has, in the camera's room.
Vec3 tilted(const Camera& camera, const Vec3& upright) {
    return Eigen::AngleAxisd(camera.tilt, Vec3::UnitY()) * upright;
}

double aspect(const QSizeF& screen) {
    return screen.width() / std::max(screen.height(), 1.0);
}

/// Half the room that the screen's height shows at this depth. [m]
double halfHeightAt(const Camera& camera, double depth) {
    return (camera.parallel ? camera.distance : depth) * std::tan(0.5 * camera.viewAngle);
}

std::array<Vec3, 8> cornersOf(const geometry::Box& box) {
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = {(i & 1) != 0 ? box.high.x() : box.low.x(), (i & 2) != 0 ? box.high.y() : box.low.y(),
                      (i & 4) != 0 ? box.high.z() : box.low.z()};
    }
    return corners;
}

}  // namespace

Vec3 Camera::eye() const {
    return focus - distance * forward();
}

Vec3 Camera::forward() const {
    return tilted(*this, -Vec3(std::cos(elevation) * std::cos(azimuth),
                               std::cos(elevation) * std::sin(azimuth), std::sin(elevation)));
}

Vec3 Camera::right() const {
    return tilted(*this, {-std::sin(azimuth), std::cos(azimuth), 0.0});
}

Vec3 Camera::up() const {
    return tilted(*this, {-std::sin(elevation) * std::cos(azimuth), -std::sin(elevation) * std::sin(azimuth),
                          std::cos(elevation)});
}

double Camera::metresPerPixel(const QSizeF& screen) const {
    return 2.0 * halfHeightAt(*this, distance) / std::max(screen.height(), 1.0);
}

std::optional<QPointF> Camera::project(const Vec3& point, const QSizeF& screen) const {
    const Vec3 seen = point - eye();
    const double depth = seen.dot(forward());
    if (!parallel && depth <= 0.01 * distance) return std::nullopt;
    const double pixelsPerMetre = 0.5 * screen.height() / halfHeightAt(*this, depth);
    return QPointF(0.5 * screen.width() + seen.dot(right()) * pixelsPerMetre,
                   0.5 * screen.height() - seen.dot(up()) * pixelsPerMetre);
}

Camera orbited(Camera camera, const QPointF& drag) {
    camera.azimuth = std::remainder(camera.azimuth - drag.x() * kTurnPerPixel, 2.0 * base::kPi);
    camera.elevation = std::clamp(camera.elevation + drag.y() * kTurnPerPixel, -kRightAngle, kRightAngle);
    camera.parallel = false;
    return camera;
}

base::Quaternion turnedAlong(const Camera& camera, const QPointF& drag) {
    const Eigen::AngleAxisd sideways(drag.x() * kTurnPerPixel, Vec3::UnitZ());
    const Eigen::AngleAxisd upright(drag.y() * kTurnPerPixel, camera.right());
    return base::Quaternion(sideways * upright);
}

Camera panned(Camera camera, const QPointF& drag, const QSizeF& screen) {
    const double scale = camera.metresPerPixel(screen);
    camera.focus += -drag.x() * scale * camera.right() + drag.y() * scale * camera.up();
    return camera;
}

Camera zoomed(Camera camera, double factor, const QPointF& place, const QSizeF& screen) {
    const double scale = camera.metresPerPixel(screen);
    const Vec3 kept = camera.focus + (place.x() - 0.5 * screen.width()) * scale * camera.right() -
                      (place.y() - 0.5 * screen.height()) * scale * camera.up();
    const double nearer = std::clamp(camera.distance / factor, kNearest, kFarthest);
    camera.focus = kept + (camera.focus - kept) * (nearer / camera.distance);
    camera.distance = nearer;
    return camera;
}

Camera turnedTo(Camera camera, StandardView view) {
    camera.parallel = view != StandardView::home;
    camera.elevation = 0.0;
    camera.azimuth = -kRightAngle;
    switch (view) {
        case StandardView::home:
            camera.azimuth = kHomeAzimuth;
            camera.elevation = kHomeElevation;
            break;
        case StandardView::top:
            camera.elevation = kRightAngle;
            break;
        case StandardView::bottom:
            camera.elevation = -kRightAngle;
            break;
        case StandardView::front:
            break;
        case StandardView::back:
            camera.azimuth = kRightAngle;
            break;
        case StandardView::left:
            camera.azimuth = base::kPi;
            break;
        case StandardView::right:
            camera.azimuth = 0.0;
            break;
    }
    return camera;
}

Camera fitted(Camera camera, const geometry::Box& box, const QSizeF& screen, double margin) {
    if ((box.high.array() < box.low.array()).any()) return camera;
    const std::array<Vec3, 8> corners = cornersOf(box);
    const double tangentY = std::tan(0.5 * camera.viewAngle) * (1.0 - 2.0 * margin);
    const double tangentX = tangentY * aspect(screen);
    camera.focus = 0.5 * (box.low + box.high);
    // A corner at (u, depth) from the focus is on the screen if |u - shift| <= tangent * (distance + depth).
    // Of all corners together, the least distance and its shift.
    const auto fitAxis = [&](const Vec3& axis, double tangent) {
        double most = -1e300;
        double least = 1e300;
        for (const Vec3& corner : corners) {
            const Vec3 offset = corner - camera.focus;
            const double reach = camera.parallel ? 0.0 : tangent * offset.dot(camera.forward());
            most = std::max(most, offset.dot(axis) - reach);
            least = std::min(least, offset.dot(axis) + reach);
        }
        return std::pair((most - least) / (2.0 * tangent), 0.5 * (most + least));
    };
    const auto [distanceX, shiftX] = fitAxis(camera.right(), tangentX);
    const auto [distanceY, shiftY] = fitAxis(camera.up(), tangentY);
    camera.distance = std::clamp(std::max(distanceX, distanceY), kNearest, kFarthest);
    camera.focus += shiftX * camera.right() + shiftY * camera.up();
    return camera;
}

}  // namespace trapwright::scene
