#pragma once

#include "ui/scene/camera.h"
#include "ui/scene/contents.h"

namespace trapwright::scene {

/// What a scene's contents are to a camera and to a legend.

/// Nothing to look at.
bool isEmpty(const SceneContents& contents);

/// Camera::tilt of these contents: the slope of a linear feeder that the track is on. [rad]
double tiltOf(const SceneContents& contents);

/// The camera from which the subject is seen best at first; to be fitted.
Camera homeCamera(const SceneContents& contents);

/// The box around what the camera has to show: the subject, or the part alone. Empty (low > high) if there is
/// nothing. [m]
geometry::Box boxOf(const SceneContents& contents);

/// What is drawn of parts: the row of stable poses, or else the parts that are there.
std::vector<PartInScene> partsOf(const SceneContents& contents);

/// Whether there is something that is coloured by its height, and that is wanted.
bool isShadedByHeight(const SceneContents& contents);

/// The lowest and the highest point of what height shading colours: of a track's surface, above its plane
/// z = 0 where that climbs; of a whole solid.
/// [m]
struct HeightRange {
    double low = 0.0;
    double high = 1.0;
};
HeightRange heightRangeOf(const SceneContents& contents);

}  // namespace trapwright::scene
