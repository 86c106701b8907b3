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
    showTime(time_);
    std::vector<scene::Trace> traces;
    for (std::size_t i = 0; view_.trace && i < trials_.size(); ++i) {
        if (!trials_[i].parts.empty()) continue;  // so many would hide the track
        for (std::size_t part = 0; part < trials_[i].motion->parts(); ++part)
            traces.push_back({trials_[i].motion->path(part, kTraceSpacing), colourOf(i)});
    }
    scene_->setTraces(std::move(traces));
    scene_->setForceLegend(view_.forces && !trials_.empty());
}

/// The part itself is in the colour that it has everywhere.
QColor ReplayScene::colourOf(std::size_t trial) const {
    return trial == 0 ? QColor() : models::verdictColour(trials_[trial].verdict);
}

QColor ReplayScene::colourOf(std::size_t trial, std::size_t part) const {
    if (trials_[trial].parts.empty()) return colourOf(trial);
    const trial::Verdict verdict = trials_[trial].parts[part];
    return verdict == trial::Verdict::success ? QColor() : models::verdictColour(verdict);
}

void ReplayScene::showTime(double time) {
    time_ = time;
    if (scene_ == nullptr || !track_) return;
    std::vector<scene::PartInScene> parts;
    for (std::size_t i = 0; i < trials_.size(); ++i) {
        const trial::RecordedMotion& motion = *trials_[i].motion;
        const bool isStream = !trials_[i].parts.empty();
        for (std::size_t part = 0; part < motion.parts(); ++part)
            if (!isStream || motion.isThere(part, time))
                parts.push_back({part_, motion.poseAt(part, time), colourOf(i, part), i > 0});
    }
    scene_->setParts(std::move(parts));
    std::vector<scene::ContactArrow> arrows;
    if (view_.forces && !trials_.empty() && time <= trials_.front().motion->duration()) {
        for (const trial::ContactForce& force : trials_.front().motion->forcesAt(time))
            arrows.push_back({force.point, force.force});
    }
    scene_->setContacts(arrows);
}

}  // namespace trapwright::pages
