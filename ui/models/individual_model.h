#pragma once

#include "core/search/methods.h"
#include "core/study/records.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

struct IndividualRow : study::Individual {
    bool winner = false;
};

/// The individuals of one generation.
class IndividualModel : public RecordModel<IndividualRow> {
    Q_OBJECT
 public:
    enum Columns {
        Individual,
        Success,
        Bounds,
        Trials,
        Finished,
        Stuck,
        FellOff,
        FirstScore  // of everybody's; then F, the scores of the algorithm, one for each trait of the search
    };
    /// The place of F: from there on is what only those who look into the algorithm need.
    static int firstDetail();

    explicit IndividualModel(QObject* parent = nullptr);

    /// Of a study that is searched so: its traits get a column each.
    void setGeneration(const study::GenerationRecord& record, const search::MethodInfo& search);
    void clear();

 protected:
    [[nodiscard]] QVariant more(const IndividualRow& row, int column, int role) const override;

 private:
    static std::vector<Column<IndividualRow>> makeColumns();
};

}  // namespace trapwright::models
