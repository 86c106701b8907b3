#pragma once

#include <QPointer>
#include <memory>
#include <optional>

#include "core/study/records.h"
#include "core/study/settings.h"
#include "core/track/track.h"
#include "ui/pages/page.h"
#include "ui/session/track_build.h"

class QLabel;
class QPushButton;
class QSpinBox;

namespace trapwright::look {
class FoldingGroup;
}

namespace trapwright::pages {

class ComparisonTable;
class EventLog;
class EvolveSummary;
class FilmStrip;
class GenerationTable;
class IndividualCard;
class IndividualTable;
class LearningCharts;
class RunActions;
class RunCard;
class SettingsForm;
class TradeOffPanel;

/// Step 3: learning is started, watched and stopped; any individual that was learned can be looked at. The
/// scene follows the best winner until another one is picked.
class EvolvePage : public Page {
    Q_OBJECT
 public:
    explicit EvolvePage(RunActions& run, QWidget* parent = nullptr);

    void setSession(session::StudySession* session) override;
    void activate(scene::SceneView& scene) override;
    void deactivate() override;
    std::vector<Panel> panels() override;
    QWidget* sceneBar() override;

 private:
    /// What a track is built from; no design: the flat track before anything is learned.
    struct Blueprint {
        study::TrackSettings settings;
        search::Design design;
        friend bool operator==(const Blueprint&, const Blueprint&) = default;
    };

    QWidget* makeThreads(QWidget* parent);
    QWidget* makeComparison();
    void addActions();
    void connectViews();

    void refresh();
    void askForComparison();
    void showComparison();
    void changeSettings();

    /// Shows the best winner (StudyRuns::bestWinner), now and whenever there is a better one.
    void follow();
    void pick(const study::Individual& individual);
    void pickWinner(int generation);
    void stepWinner(int step);
    void showPicked();
    void buildTrack(const study::Individual* individual);
    void showScene();
    [[nodiscard]] const study::Individual* shown() const;
    [[nodiscard]] QString captionOf(const study::Individual& individual) const;

    QPointer<session::StudySession> session_;
    scene::SceneView* scene_ = nullptr;        // while the page is shown
    std::optional<study::Individual> picked_;  // none: the best winner is followed
    session::TrackBuild build_;
    std::optional<Blueprint> blueprint_;  // what track_ is built from, or being built from
    std::shared_ptr<const track::Track> track_;
    QAction* followAction_;

    RunCard* card_;
    SettingsForm* form_;
    QSpinBox* threads_;
    look::FoldingGroup* individualGroup_;
    IndividualCard* individual_;
    EvolveSummary* summary_;
    QLabel* compared_;
    ComparisonTable* comparison_;
    QPushButton* compare_;
    QPushButton* endComparison_;
    LearningCharts* charts_;
    // The window owns these.
    GenerationTable* generations_;
    IndividualTable* individuals_;
    TradeOffPanel* tradeOff_;
    EventLog* log_;
    FilmStrip* strip_;
};

}  // namespace trapwright::pages
