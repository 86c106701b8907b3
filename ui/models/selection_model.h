#pragma once

#include <optional>
#include <span>

#include "core/stats/binomial.h"
#include "core/study/records.h"
#include "core/study/robustness.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

struct SelectionRow {
    int rank = 1;
    study::SelectionEntry entry;
    stats::Interval bounds;   // of the success rate; [0, 1] without trials
    stats::Interval corners;  // of that in the operating box's corners; likewise
    /// In the corner of the box that is worst for this track, where its robustness was measured.
    std::optional<stats::Count> worst{};
};

/// The winners that were re-simulated, best first.
class SelectionModel : public RecordModel<SelectionRow> {
    Q_OBJECT
 public:
    enum Columns {
        Rank,
        Generation,
        Individual,
        Success,
        Bounds,
        Corners,
        Worst,
        Trials,
        Finished,
        FirstScore
    };
    /// The scores from there on are what only those who look into the algorithm need.
    static int firstDetail();

    explicit SelectionModel(QObject* parent = nullptr);

    /// `measured`: what is known of how robust tracks are, these among them.
    void setSelection(const study::SelectionRecord& record,
                      std::span<const study::RobustnessRecord> measured = {});
    void clear();

 protected:
    [[nodiscard]] QVariant more(const SelectionRow& row, int column, int role) const override;

 private:
    static std::vector<Column<SelectionRow>> makeColumns();
};

}  // namespace trapwright::models
