#pragma once

#include <QSortFilterProxyModel>
#include <array>
#include <optional>
#include <set>

#include "core/trial/outcome.h"
#include "core/workflow/study_trials.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

struct TrialRow {
    int trial = 0;  // from 0
    int pose = -1;  // of the part's stable poses, where the trial began; -1: anyhow
    trial::Verdict verdict = trial::Verdict::success;
    trial::PartOutcome outcome;
    std::optional<double> angle{};  // of the last orientation to the expected one, if it finished [rad]
};

/// Simulated trials of one individual.
class TrialModel : public RecordModel<TrialRow> {
    Q_OBJECT
 public:
    enum Columns { Trial, Verdict, Pose, Angle, Time, Distance };

    explicit TrialModel(QObject* parent = nullptr);

    /// Their numbers must rise.
    void setTrials(std::vector<TrialRow> rows);
    [[nodiscard]] int count(trial::Verdict verdict) const;
    /// The row of a trial; -1 if it is not there.
    [[nodiscard]] int rowOf(int trial) const;

 protected:
    [[nodiscard]] QVariant more(const TrialRow& row, int column, int role) const override;

 private:
    static std::vector<Column<TrialRow>> makeColumns();
};

/// The trials that ended in certain ways; sorts by the numbers behind the texts.
class TrialFilter : public QSortFilterProxyModel {
    Q_OBJECT
 public:
    explicit TrialFilter(QObject* parent = nullptr);

    /// All four at first.
    void setVerdicts(std::set<trial::Verdict> verdicts);
    [[nodiscard]] const std::set<trial::Verdict>& verdicts() const { return verdicts_; }
    /// Only trials that began in this pose; none: in any.
    void setPose(std::optional<int> pose);

 protected:
    [[nodiscard]] bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

 private:
    std::set<trial::Verdict> verdicts_;
    std::optional<int> pose_;
};

}  // namespace trapwright::models
