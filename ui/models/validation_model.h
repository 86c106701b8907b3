#pragma once

#include <optional>
#include <set>

#include "core/study/robustness.h"
#include "core/study/validation.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

struct ValidationTableRow {
    enum class Kind { group, pose, condition, slice, weighted, correct, total };

    Kind kind = Kind::group;
    std::vector<int> poses;                     // of the row; none: a total, or of a condition
    QString condition = {};                     // its name, of a row of it
    QString range = {};                         // of it
    std::optional<study::BoxSlice> slice = {};  // whose trials it counts
    std::optional<double> weight;               // how often parts land so
    study::ValidationRow row;
    std::optional<double> rate;  // of success
    stats::Interval bounds;      // 95 %, of it; [0, 1] without trials
    bool opens = false;          // a group of several poses, or a condition
    bool open = false;
};

/// The paper's Tables 2 and 3: a row for each group of alike stable poses, which opens to its poses; where
/// trials varied over the operating box, one for each condition, which opens to the quarters of its range;
/// last the totals, weighted by how often parts land so and with all trials alike, and between them, where
/// parts fall off, the right ones of those that arrive. In the columns that count failures VerdictRole says
/// of which kind.
class ValidationModel : public RecordModel<ValidationTableRow> {
    Q_OBJECT
 public:
    enum Columns { Pose, Weight, Trials, Failures, Success, Bounds, WrongOrientation, Stuck, FellOff };

    explicit ValidationModel(QObject* parent = nullptr);

    /// The groups that are open stay open.
    void setValidation(const study::ValidationTable& table);
    /// The same trials by the conditions that they varied over; none: they were all alike, or it is not
    /// known.
    void setConditions(std::vector<study::SlicedCondition> conditions);
    void clear();
    /// Opens or closes the group or condition in this row; of other rows nothing.
    void toggle(int row);
    /// The last rows, which are the totals.
    [[nodiscard]] int totals() const { return totals_; }

 protected:
    [[nodiscard]] QVariant more(const ValidationTableRow& row, int column, int role) const override;

 private:
    static std::vector<Column<ValidationTableRow>> makeColumns();
    void refill();
    void addConditions(std::vector<ValidationTableRow>& rows) const;

    study::ValidationTable table_;
    std::vector<study::SlicedCondition> conditions_;
    std::set<std::vector<int>> open_;  // groups, by their poses
    std::set<QString> openConditions_;
    bool anyOpens_ = false;
    int totals_ = 0;
};

}  // namespace trapwright::models
