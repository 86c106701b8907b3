#pragma once

#include "ui/scene/overlay.h"

namespace trapwright::scene {

/// Arrows of round forces in N with their lengths in the scene, at its top left. The contents have a part.
OverlayItem makeForceLegend(const SceneContents& contents, const Camera& camera, const QSizeF& screen);

}  // namespace trapwright::scene
