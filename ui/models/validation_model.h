#pragma once

#include <optional>

#include "core/stats/binomial.h"
#include "core/study/records.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

struct ValidationTableRow {
    study::ValidationRow row;  // pose -1: the total
    stats::Interval bounds;    // of the success rate; [0, 1] without trials
};

/// The paper's Tables 2 and 3: a row for each stable pose, last the total. In the columns that count failures
/// VerdictRole says of which kind, PoseRole of which pose.
class ValidationModel : public RecordModel<ValidationTableRow> {
    Q_OBJECT
 public:
    enum Columns { Pose, Trials, Failures, Success, Bounds, WrongOrientation, Stuck, FellOff };

    explicit ValidationModel(QObject* parent = nullptr);

    void setValidation(const study::ValidationRecord& record);
    void clear();

 protected:
    [[nodiscard]] QVariant more(const ValidationTableRow& row, int column, int role) const override;

 private:
    static std::vector<Column<ValidationTableRow>> makeColumns();
};

}  // namespace trapwright::models
