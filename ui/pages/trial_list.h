#pragma once

#include <QHash>
#include <QWidget>
#include <optional>
#include <set>
#include <vector>

#include "core/workflow/study_trials.h"
#include "ui/models/trial_model.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QSpinBox;
class QStackedLayout;
class QTableView;
class QToolButton;

namespace trapwright::pages {

/// Trials of one individual that a study holds the results of.
struct TrialSource {
    QString name;  // "Validation, pose 2"
    workflow::TrialsRequest request;
    int count = 0;
    std::optional<study::BoxSlice> slice{};  // the trials in there alone
};

/// The simulated trials of one individual: which ones, how each ended, filters by that, and which are
/// replayed. The current one is; the other selected ones go along as ghosts.
class TrialList : public QWidget {
    Q_OBJECT
 public:
    TrialList();

    void setSources(const std::vector<TrialSource>& sources, int current);
    /// What is shown as long as there are no trials.
    void setEmptyText(const QString& text);

    /// Where the trials come from, below them; empty: nothing.
    void setOrigin(const QString& text);

    /// The first trials of `wanted`; what was selected stays selected.
    void setTrials(std::vector<models::TrialRow> rows, int wanted);
    [[nodiscard]] const models::TrialModel& trials() const { return model_; }
    [[nodiscard]] const models::TrialFilter& filter() const { return filter_; }

    void setVerdicts(const std::set<trial::Verdict>& verdicts);
    /// Of trials that began in poses which look the same only those of this one; none: of all.
    void setPose(std::optional<int> pose);
    /// Selects this trial alone.
    void select(int trial);
    /// The first that is shown; none if none is.
    [[nodiscard]] std::optional<int> firstShown() const;
    /// The current one, then the ghosts.
    [[nodiscard]] std::vector<int> chosen() const;

 signals:
    void sourceChosen(int source);
    void stopWanted();
    void chosenChanged();
    /// A trial was double-clicked or entered.
    void playWanted();

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    QWidget* makeChips();
    QWidget* makeFoot();
    void makeTable();
    void sizeColumns();
    void fitColumns();
    void applyChips();
    void applyPose();
    void listPoses(const std::vector<int>& poses);
    void showCounts(int wanted);

    models::TrialModel model_;
    models::TrialFilter filter_;
    QComboBox* source_;
    QComboBox* pose_;                 // to choose one of several that look the same
    QHash<int, QToolButton*> chips_;  // by verdict
    QTableView* table_;
    QLabel* empty_;
    QStackedLayout* stack_;
    QSpinBox* ghosts_;
    QLabel* origin_;
    QWidget* busy_;
    QLabel* busyText_;
    QProgressBar* bar_;
    bool restoring_ = false;
    int columnsNeed_ = 0;  // to be read without scrolling [px]
};

}  // namespace trapwright::pages
