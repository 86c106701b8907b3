#pragma once

#include "core/part/part.h"
#include "ui/scene/overlay.h"

namespace trapwright::scene {

/// How long the arrow of a force [N] on this part is: a bounding radius at the part's weight, and from there
/// with the square root, because impacts are a hundred times the weight; never beyond six radii. 0 for no
/// force. [m]
double arrowLength(const part::Part& part, double force);

/// Arrows of round forces in N with their lengths in the scene, at its top left. The contents have a part.
OverlayItem makeForceLegend(const SceneContents& contents, const Camera& camera, const QSizeF& screen);

}  // namespace trapwright::scene
