#pragma once

#include <QColor>
#include <memory>
#include <vector>

#include "core/part/part.h"
#include "core/track/track.h"
#include "core/trial/recorded_motion.h"
#include "core/workflow/study_trials.h"

namespace trapwright::scene {
class SceneView;
}

namespace trapwright::pages {

/// A trial that is shown, and how it is counted.
struct ReplayedTrial {
    int trial = 0;
    trial::Verdict verdict = trial::Verdict::success;
    std::shared_ptr<const trial::RecordedMotion> motion;
    std::vector<trial::Verdict> parts{};  // of a stream: what each part counts as; empty: it is none
};

/// What of a replay is drawn beside the part.
struct ReplayView {
    bool trace = true;
    bool forces = false;
};

/// A track with the trials that are replayed on it, in the 3D scene: the parts of the first as they are,
/// those of the others as ghosts in the colours of their verdicts. Parts of a stream are seen while they are
/// on the track, those that do not leave it as wanted in the colours of what they will count as.
class ReplayScene {
 public:
    /// The scene to draw in from now on, at once with everything; null: none.
    void setScene(scene::SceneView* scene);
    void setTrack(std::shared_ptr<const track::Track> track, std::shared_ptr<const part::Part> part);
    void setTrials(std::vector<ReplayedTrial> trials);
    void setView(const ReplayView& view);

    [[nodiscard]] const std::vector<ReplayedTrial>& trials() const { return trials_; }
    [[nodiscard]] const ReplayView& view() const { return view_; }
    /// Until the longest of the trials ends. [s]
    [[nodiscard]] double duration() const;

    void showTime(double time);

 private:
    void showTrack();
    void showTrials();
    [[nodiscard]] QColor colourOf(std::size_t trial) const;
    [[nodiscard]] QColor colourOf(std::size_t trial, std::size_t part) const;

    scene::SceneView* scene_ = nullptr;
    std::shared_ptr<const track::Track> track_;
    std::shared_ptr<const part::Part> part_;
    std::vector<ReplayedTrial> trials_;
    ReplayView view_;
    double time_ = 0.0;
};

}  // namespace trapwright::pages
