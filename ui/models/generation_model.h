#pragma once

#include <optional>

#include "core/search/methods.h"
#include "core/study/records.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

/// A generation with the check of its winner, if that is done.
struct GenerationRow {
    study::GenerationSummary summary;
    std::optional<study::CheckRecord> check;
};

/// All generations of a study.
class GenerationModel : public RecordModel<GenerationRow> {
    Q_OBJECT
 public:
    enum Columns {
        Generation,
        Individual,
        Success,
        Bounds,
        TopSuccess,
        LearningSuccess,
        ReferenceSuccess,
        Seconds,
        // Of everybody's; then F, the scores of the algorithm, the mean F of the top 30 %, one for each curve
        // of the search.
        FirstScore
    };
    /// The place of F: from there on is what only those who look into the algorithm need.
    static int firstDetail();

    explicit GenerationModel(QObject* parent = nullptr);

    /// Of a study that is searched so: its curves get a column each.
    void setGenerations(const std::vector<study::GenerationSummary>& summaries,
                        const std::vector<study::CheckRecord>& checks, const search::MethodInfo& search);
    void append(const study::GenerationSummary& summary);
    /// The check of a generation that is there; others are ignored.
    void setCheck(const study::CheckRecord& check);

 protected:
    [[nodiscard]] QVariant more(const GenerationRow& row, int column, int role) const override;

 private:
    static std::vector<Column<GenerationRow>> makeColumns();
};

}  // namespace trapwright::models
