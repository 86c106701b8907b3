#include "ui/pages/track_in_scene.h"

#include "core/trial/start.h"
#include "ui/scene/scene_view.h"

namespace trapwright::pages {

void showTrackWithPart(scene::SceneView& scene, const std::shared_ptr<const track::Track>& track,
                       const std::shared_ptr<const part::Part>& part) {
    scene.showTrack(track);
    if (!track || !part) return;
    scene.showPart(part);
    if (part->stablePoses.empty()) return;
    base::Random random({});
    const trial::StartPolicy lying{part->stablePoses.front().rotation, 0.0, 0.0};
    const base::Pose pose = trial::drawStart(*track, *part, lying, random).pose;
    scene.setPartPoses({&pose, 1});
}

}  // namespace trapwright::pages
