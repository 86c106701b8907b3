#pragma once

#include "core/evolution/transition.h"
#include "core/study/records.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

struct IndividualRow {
    int generation = 0;
    int individual = 0;
    bool winner = false;
    study::IndividualRecord record;
    evolution::StrategyValues strategy;  // as it takes effect
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
        Total,
        Collision,
        Distance,
        Orientation,
        Crossover,
        Mutation,
        Smoothing
    };
    /// What only those who look into the algorithm need.
    static constexpr int kFirstDetail = Total;

    explicit IndividualModel(QObject* parent = nullptr);

    /// `bounds` are those of the study's settings (study::generationParameters).
    void setGeneration(const study::GenerationRecord& record, const evolution::TransitionParameters& bounds);
    void clear();

 protected:
    [[nodiscard]] QVariant more(const IndividualRow& row, int column, int role) const override;

 private:
    static std::vector<Column<IndividualRow>> makeColumns();
};

}  // namespace trapwright::models
