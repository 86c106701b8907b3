#pragma once

#include <QPointer>
#include <memory>

#include "ui/models/selection_model.h"
#include "ui/models/validation_model.h"
#include "ui/pages/page.h"
#include "ui/pages/trial_review.h"

namespace trapwright::pages {

class JudgingCard;
class ReplayFiles;
class RobustnessPanel;
class StreamPanel;
class ResultTable;
class TrackChoice;

/// Step 4: how good a track is. The best winners are compared, the chosen one is validated, how it does where
/// the physics is another and where parts follow each other is measured, and every trial can be looked at.
class ReviewPage : public Page {
    Q_OBJECT
 public:
    explicit ReviewPage(QWidget* parent = nullptr);
    ~ReviewPage() override;

    void setSession(session::StudySession* session) override;
    void activate(scene::SceneView& scene) override;
    void deactivate() override;
    std::vector<Panel> panels() override;
    QWidget* sceneBar() override;

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void addInspector();
    void addTables();
    void addKeys();
    void showWinner();
    void showSelection();
    void showValidation();
    void showRobustness();
    void showStreams();
    void askForSlices(const study::ValidationRecord& record, int number);
    void goToFailures(const QModelIndex& cell);

    QPointer<const session::StudySession> session_;
    QPointer<session::StudyReplays> replays_;  // of the session
    TrialReview review_;
    models::SelectionModel selection_;
    models::ValidationModel validation_;
    int sliced_ = -1;  // the validation whose trials were asked for by their conditions
    TrackChoice* choice_;
    JudgingCard* judging_;
    ReplayFiles* files_;
    std::unique_ptr<ResultTable> selectionTable_;  // until the window takes it
    std::unique_ptr<ResultTable> validationTable_;
    std::unique_ptr<RobustnessPanel> robustness_;
    std::unique_ptr<StreamPanel> streams_;
    QPointer<ResultTable> shownSelection_;
    QPointer<ResultTable> shownValidation_;
    QPointer<RobustnessPanel> shownRobustness_;
    QPointer<StreamPanel> shownStreams_;
};

}  // namespace trapwright::pages
