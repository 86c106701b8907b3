#pragma once

#include "core/stats/binomial.h"
#include "core/study/records.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

struct SelectionRow {
    int rank = 1;
    study::SelectionEntry entry;
    stats::Interval bounds;   // of the success rate; [0, 1] without trials
    stats::Interval corners;  // of that in the operating box's corners; likewise
};

/// The winners that were re-simulated, best first.
class SelectionModel : public RecordModel<SelectionRow> {
    Q_OBJECT
 public:
    enum Columns { Rank, Generation, Individual, Success, Bounds, Corners, Trials, Finished, FirstScore };
    /// The scores from there on are what only those who look into the algorithm need.
    static int firstDetail();

    explicit SelectionModel(QObject* parent = nullptr);

    void setSelection(const study::SelectionRecord& record);
    void clear();

 protected:
    [[nodiscard]] QVariant more(const SelectionRow& row, int column, int role) const override;

 private:
    static std::vector<Column<SelectionRow>> makeColumns();
};

}  // namespace trapwright::models
