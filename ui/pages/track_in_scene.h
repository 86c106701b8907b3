#pragma once

#include <memory>

#include "core/part/part.h"
#include "core/track/track.h"

namespace trapwright::scene {
class SceneView;
}

namespace trapwright::pages {

/// Puts a track into the scene with the part at its start point, as it lies most often, which shows how large
/// it is beside the track.
void showTrackWithPart(scene::SceneView& scene, const std::shared_ptr<const track::Track>& track,
                       const std::shared_ptr<const part::Part>& part);

}  // namespace trapwright::pages
