#pragma once

#include <QObject>
#include <QPointer>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "core/study/orientation_shares.h"
#include "ui/pages/replay_player.h"
#include "ui/pages/replay_scene.h"
#include "ui/pages/trial_list.h"
#include "ui/session/study_replays.h"
#include "ui/session/track_build.h"
#include "ui/session/work_thread.h"

namespace trapwright::charts {
class OrientationChart;
}

namespace trapwright::pages {

class PlaybackBar;

/// The trials of one individual of a study: listed, replayed in the scene, and their orientations as a chart.
/// Trials are asked for when they are to be seen.
class TrialReview : public QObject {
    Q_OBJECT
 public:
    explicit TrialReview(QObject* parent);
    ~TrialReview() override;

    /// Widgets for their places in the window, which owns them from then on.
    [[nodiscard]] TrialList* list() const;
    [[nodiscard]] PlaybackBar* bar() const;
    [[nodiscard]] charts::OrientationChart* orientation() const;
    [[nodiscard]] ReplayPlayer& player() { return player_; }
    [[nodiscard]] const ReplayScene& scene() const { return scene_; }

    void setReplays(session::StudyReplays* study);
    /// What was asked for of the study does not come: the window tells why.
    void endWaiting();
    void setWinner(const std::optional<study::Individual>& winner);
    /// Lists its trials anew, after a selection or validation added some.
    void refreshSources();
    /// Where replays are seen; null while they are not.
    void setScene(scene::SceneView* scene);

    /// Lists the validation's trials of these poses that ended so, and plays the first of them as soon as it
    /// is known. One pose of several that look the same is listed alone.
    void goToTrials(const std::vector<int>& poses, const std::set<trial::Verdict>& verdicts);
    /// Likewise trials that robustness was measured by, which become a source of this track. `name`: where
    /// they are in the operating box.
    void goToRobustness(const workflow::RobustnessTrials& trials, const QString& name,
                        const std::set<trial::Verdict>& verdicts);

    /// Likewise the streams of an inflow.
    void goToStream(const workflow::StreamTrials& trials, const QString& name);

    /// Likewise the `count` trials of the validation, whatever their pose, in this slice of the operating
    /// box.
    void goToSlice(const QString& name, const study::BoxSlice& slice, int count,
                   const std::set<trial::Verdict>& verdicts);

 signals:
    void failed(const QString& what, const QString& message);
    void chosenChanged();

 private:
    void goToPlace(const TrialSource& place, const std::set<trial::Verdict>& verdicts);
    void showTrack();
    void makeSources();
    void setSource(int source);
    void wantTrials();
    void takeTrials(const session::ListedTrials& trials);
    void showTrials(std::vector<models::TrialRow> rows, int wanted, study::OrientationShares shares,
                    double tolerance);
    void showOrigin(const session::ListedTrials& trials);
    void playFirstShown();
    void wantReplays();
    void takeReplay(const workflow::TrialsRequest& request, int trial,
                    const std::shared_ptr<const trial::Trajectory>& trajectory,
                    const std::optional<workflow::OutcomeDifference>& difference);
    void showReplays();
    void showDifferences();
    void forgetTrials();
    /// Of a stream what each part counts as; of other trials nothing.
    [[nodiscard]] std::vector<trial::Verdict> judgeParts(const workflow::TrialsRequest& request,
                                                         const trial::Outcome& outcome) const;
    [[nodiscard]] bool isShown(const workflow::TrialsRequest& request) const;

    QPointer<session::StudyReplays> study_;
    std::optional<study::Individual> winner_;
    std::vector<TrialSource> sources_;
    std::optional<TrialSource> place_;  // in the operating box; of this winner
    int source_ = 0;
    bool visible_ = false;
    bool listed_ = false;         // the trials of the source are there or on their way
    bool playWanted_ = false;     // the first trial shown, when there is one
    std::vector<int> wanted_;     // replays, as they are to be shown
    std::vector<int> requested_;  // of these, that have not come yet
    std::vector<ReplayedTrial> replays_;
    std::map<int, workflow::OutcomeDifference> differences_;  // of replays to what is stored, by trial

    session::TrackBuild build_;
    session::NewestTask counting_;
    std::shared_ptr<const track::Track> track_;
    ReplayPlayer player_;
    ReplayScene scene_;
    QPointer<TrialList> list_;
    QPointer<PlaybackBar> bar_;
    QPointer<charts::OrientationChart> orientation_;
};

}  // namespace trapwright::pages
