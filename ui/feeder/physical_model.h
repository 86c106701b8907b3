#pragma once

#include "core/study/physical_table.h"
#include "ui/models/record_model.h"

namespace trapwright::feeder {

/// The paper's Tables 2 and 3, simulated and real feeder side by side: a row for each group of alike stable
/// poses, last the totals, weighted by how often parts land so and with all trials alike. Bounds are those of
/// Clopper and Pearson, as in the report.
class PhysicalModel : public models::RecordModel<study::PhysicalRow> {
    Q_OBJECT
 public:
    enum Columns {
        Pose,
        SimulatedTrials,
        SimulatedFailures,
        SimulatedSuccess,
        SimulatedBounds,
        Trials,
        Planned,
        Failures,
        Success,
        Bounds,
        WrongOrientation,
        Stuck,
        FellOff,
        Difference
    };

    explicit PhysicalModel(QObject* parent = nullptr);

    /// The last rows, which are the totals.
    static constexpr int kTotals = 2;
    void setTable(const study::PhysicalTable& table);
    void clear();

 protected:
    [[nodiscard]] QVariant more(const study::PhysicalRow& row, int column, int role) const override;

 private:
    static std::vector<models::Column<study::PhysicalRow>> makeColumns();
};

}  // namespace trapwright::feeder
