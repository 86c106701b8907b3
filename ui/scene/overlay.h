#pragma once

#include <QPainter>
#include <functional>
#include <optional>
#include <vector>

#include "ui/scene/camera.h"
#include "ui/scene/contents.h"

namespace trapwright::scene {

/// One thing drawn over the scene: a label, the legend, the scale bar, the orbit cube. Logical pixels.
struct OverlayItem {
    QRectF area;
    std::function<void(QPainter&)> paint;  // in the screen's coordinates, within the area
};

/// What lies over a scene of this size. `hovered`: the orbit cube's face under the mouse.
std::vector<OverlayItem> overlayOf(const SceneContents& contents, const Camera& camera, const QSizeF& screen,
                                   std::optional<StandardView> hovered);

void paintOverlay(QPainter& painter, const std::vector<OverlayItem>& items);

}  // namespace trapwright::scene
