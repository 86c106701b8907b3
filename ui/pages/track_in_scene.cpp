#include "ui/pages/track_in_scene.h"

#include "core/trial/start.h"
#include "ui/scene/scene_view.h"

namespace trapwright::pages {

void showTrackWithPart(scene::SceneView& scene, const std::shared_ptr<const track::Track>& track,
                       const std::shared_ptr<const part::Part>& part) {
    scene.showTrack(track);
    if (!track || !part) return;
    if (part->stablePoses.empty()) return scene.setParts({{part, {}}});
    const trial::StartPolicy lying{part->stablePoses.front().rotation, 0.0, 0.0};
    const base::Pose pose = trial::drawTrial(*track, *part, lying, {}).parts.front().pose;
    scene.setParts({{part, pose}});
}

}  // namespace trapwright::pages
