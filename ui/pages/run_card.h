#pragma once

#include <QPointer>
#include <QWidget>

class QLabel;
class QProgressBar;
class QToolButton;

namespace trapwright::session {
class StudyRuns;
enum class RunState;
struct RunProgress;
}  // namespace trapwright::session

namespace trapwright::pages {

class RunActions;
class SuccessCard;

/// How good the best winner is, what a study is doing, how far it is and how long it takes, with the buttons
/// that start and end learning.
class RunCard : public QWidget {
    Q_OBJECT
 public:
    RunCard(RunActions& run, QWidget* parent);

    void setRuns(const session::StudyRuns* runs);

 signals:
    /// The settings have to be mended first.
    void settingsWanted();

 private:
    QToolButton* makeButton(QAction* action, const QString& name);
    void update();
    void announce();
    void showSuccess();
    void showStandstill();
    void showRemade();
    void showCluster();
    void showIdle();
    void showDraft();
    void showRun(session::RunState state);
    void showJob(const session::RunProgress& progress);
    [[nodiscard]] QString workText() const;

    QPointer<const session::StudyRuns> runs_;
    SuccessCard* success_;
    QLabel* title_;
    QLabel* detail_;
    QLabel* standstill_;
    QToolButton* corners_;
    QToolButton* cluster_;
    QLabel* remade_;
    QLabel* speed_;
    QProgressBar* bar_;
    QWidget* draft_;
    QLabel* draftTime_;
    RunActions& run_;
    bool hasQueue_;  // jobs of a cluster can be submitted from here
};

}  // namespace trapwright::pages
