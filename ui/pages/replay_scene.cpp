#include "ui/pages/replay_scene.h"

#include <algorithm>

#include "ui/models/verdict_look.h"
#include "ui/scene/scene_view.h"

namespace trapwright::pages {

namespace {

constexpr double kTraceSpacing = 0.2e-3;  // [m]

}  // namespace

void ReplayScene::setScene(scene::SceneView* scene) {
    if (scene_ != nullptr && scene == nullptr) scene_->setForceLegend(false);
    scene_ = scene;
    showTrack();
}

void ReplayScene::setTrack(std::shared_ptr<const track::Track> track,
                           std::shared_ptr<const part::Part> part) {
    trials_.clear();
    if (track == track_ && part == part_) return showTrials();
    track_ = std::move(track);
    part_ = std::move(part);
    showTrack();
}

void ReplayScene::setTrials(std::vector<ReplayedTrial> trials) {
    trials_ = std::move(trials);
    showTrials();
}

void ReplayScene::setView(const ReplayView& view) {
    view_ = view;
    showTrials();
}

double ReplayScene::duration() const {
    double duration = 0.0;
    for (const ReplayedTrial& trial : trials_)
        duration = std::max(duration, trial.motion->duration());
    return duration;
}

void ReplayScene::showTrack() {
    if (scene_ == nullptr) return;
    if (!track_) return scene_->clear();
    scene_->showTrack(track_);
    showTrials();
}

void ReplayScene::showTrials() {
    if (scene_ == nullptr || !track_) return;
    const std::shared_ptr<const part::Part> part = trials_.empty() ? nullptr : part_;
    // A part that is there stays in view, where the camera may follow it.
    if (scene_->contents().part != part) scene_->showPart(part);
    std::vector<QColor> colours;
    std::vector<scene::Trace> traces;
    for (const ReplayedTrial& trial : trials_) {
        // The part itself is in the colour that it has everywhere.
        const bool ghost = !colours.empty();
        colours.push_back(ghost ? models::verdictColour(trial.verdict) : QColor());
        if (view_.trace) traces.push_back({trial.motion->path(kTraceSpacing), colours.back()});
    }
    scene_->setPartColours(colours);
    scene_->setTraces(std::move(traces));
    scene_->setForceLegend(view_.forces && !trials_.empty());
    showTime(time_);
}

void ReplayScene::showTime(double time) {
    time_ = time;
    if (scene_ == nullptr || trials_.empty()) return;
    std::vector<base::Pose> poses;
    poses.reserve(trials_.size());
    for (const ReplayedTrial& trial : trials_)
        poses.push_back(trial.motion->poseAt(time));
    scene_->setPartPoses(poses);
    std::vector<scene::ContactArrow> arrows;
    if (view_.forces && time <= trials_.front().motion->duration()) {
        for (const trial::ContactForce& force : trials_.front().motion->forcesAt(time))
            arrows.push_back({force.point, force.force});
    }
    scene_->setContacts(arrows);
}

}  // namespace trapwright::pages
