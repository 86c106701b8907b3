#pragma once

#include <QPainter>
#include <optional>

#include "ui/scene/camera.h"
#include "ui/scene/theme.h"

namespace trapwright::scene {

/// The small cube at the top right that shows how the camera is turned, with the axes at its corner. A click
/// on a face turns the camera there. Places in logical pixels.

/// Where it lies on a screen of this width.
QRectF orbitCubeArea(const QSizeF& screen);

/// The face under a place, if one is.
std::optional<StandardView> orbitCubeFaceAt(const Camera& camera, const QSizeF& screen, const QPointF& place);

void paintOrbitCube(QPainter& painter, const Camera& camera, const SceneTheme& theme, const QSizeF& screen,
                    std::optional<StandardView> hovered);

}  // namespace trapwright::scene
