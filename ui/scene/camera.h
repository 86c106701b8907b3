#pragma once

#include <QPointF>
#include <QSizeF>
#include <optional>

#include "core/base/math.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::scene {

enum class StandardView { home, top, bottom, front, back, left, right };

/// A camera that keeps what is upright so, turning about a focus: the room's z, or on a sloped linear feeder,
/// whose room is tilted with it, what plumbs there. Lengths in metres, angles in radians,
/// places on the screen in logical pixels from the top left.
struct Camera {
    base::Vec3 focus = base::Vec3::Zero();
    double azimuth = -55.0 * base::kDegree;   // of the eye seen from the focus, from x towards y
    double elevation = 35.0 * base::kDegree;  // of the eye above the horizon
    double distance = 0.5;
    double viewAngle = 24.0 * base::kDegree;  // of the screen's height
    bool parallel = false;                    // as large as in perspective at the focus
    double tilt = 0.0;                        // upright is (sin(tilt), 0, cos(tilt))

    [[nodiscard]] base::Vec3 eye() const;
    [[nodiscard]] base::Vec3 forward() const;
    [[nodiscard]] base::Vec3 right() const;
    [[nodiscard]] base::Vec3 up() const;
    /// Length in the room of one pixel, at the distance of the focus. [m]
    [[nodiscard]] double metresPerPixel(const QSizeF& screen) const;
    /// Where a point is on the screen; none behind the eye.
    [[nodiscard]] std::optional<QPointF> project(const base::Vec3& point, const QSizeF& screen) const;

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// The camera turned by a drag of this many pixels; in perspective from then on.
Camera orbited(Camera camera, const QPointF& drag);
/// The turn of a thing at the focus that lets the side of it which is seen follow the drag.
base::Quaternion turnedAlong(const Camera& camera, const QPointF& drag);
/// The camera moved so that what lies at the focus follows the drag.
Camera panned(Camera camera, const QPointF& drag, const QSizeF& screen);
/// The camera nearer by `factor`, with the point under `place` kept there.
Camera zoomed(Camera camera, double factor, const QPointF& place, const QSizeF& screen);
/// The camera turned to a standard view. All but home are parallel projections.
Camera turnedTo(Camera camera, StandardView view);
/// The camera moved so that the box fills the screen but for `margin`, a share of it on every side.
Camera fitted(Camera camera, const geometry::Box& box, const QSizeF& screen, double margin = 0.08);

}  // namespace trapwright::scene
