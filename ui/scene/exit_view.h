#pragma once

#include <QImage>
#include <array>

#include "ui/scene/camera.h"
#include "ui/scene/contents.h"

namespace trapwright::scene {

/// How the operator sees a part that leaves the track. He stands where a hand reaches the track: beside a
/// linear feeder on its inner side, from where parts go to the right, or outside a bowl.
struct ExitView {
    Camera camera;
    std::array<base::Vec3, 7> arrow;  // outline of the conveying arrow beside the part, in the room [m]
};

/// From as low as home, higher where the track would hide more of the part. `size` is logical.
ExitView makeExitView(const track::Track& track, const part::Part& part, const base::Pose& pose, QSizeF size);

/// Over a picture of this view.
void paintArrow(QImage& picture, const ExitView& view, const SceneTheme& theme);

}  // namespace trapwright::scene
