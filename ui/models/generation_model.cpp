#include "ui/models/generation_model.h"

#include <algorithm>

#include "ui/models/number_columns.h"
#include "ui/models/numbers.h"

namespace trapwright::models {

namespace {

using Row = GenerationRow;

const objectives::Fitness& bestOf(const Row& row) {
    return row.summary.statistics.best;
}

/// Success in the winner's check, by one of its engines.
QVariant successValue(const Row& row, const study::EngineScore study::CheckRecord::*engine) {
    if (!row.check) return {};
    return percentValue(((*row.check).*engine).oriented, row.check->trials);
}

QString successText(const Row& row, const study::EngineScore study::CheckRecord::*engine) {
    if (!row.check) return {};
    return percent(((*row.check).*engine).oriented, row.check->trials);
}

QVariant topSuccessValue(const Row& row) {
    const std::optional<double>& share = row.summary.statistics.topSuccess;
    return share ? QVariant(100.0 * *share) : QVariant();
}

QString topSuccessText(const Row& row) {
    const std::optional<double>& share = row.summary.statistics.topSuccess;
    return share ? fixed(100.0 * *share, 1) : QStringLiteral("–");
}

}  // namespace

GenerationModel::GenerationModel(QObject* parent) : RecordModel(makeColumns(), parent) {}

std::vector<Column<GenerationRow>> GenerationModel::makeColumns() {
    std::vector<Column<Row>> columns = {
        {tr("Generation"), tr("Counted from 0."), [](const Row& r) { return QVariant(r.summary.index); },
         [](const Row& r) {
             return r.summary.mendedFrom ? tr("%1, mended").arg(r.summary.index)
                                         : QString::number(r.summary.index);
         }},
        {tr("Winner"), tr("Number of the generation's best individual."),
         [](const Row& r) { return QVariant(r.summary.winner); },
         [](const Row& r) { return QString::number(r.summary.winner); }},
        {tr("Success [%]"),
         tr("Parts of the winner that finished in the expected orientation, of all its trials."),
         [](const Row& r) { return percentValue(r.summary.statistics.success); },
         [](const Row& r) { return percent(r.summary.statistics.success); }},
        {tr("Bounds [%]"), boundsHelp() + u' ' + tr("Sorted by the lower bound."),
         [](const Row& r) { return boundsValues(r.summary.statistics.success).front(); },
         [](const Row& r) { return boundsText(r.summary.statistics.success); },
         [] { return boundsTitles(tr("Success")); },
         [](const Row& r) { return boundsValues(r.summary.statistics.success); }},
        {tr("Top 30 % [%]"), tr("Mean success of the best 30 % of the generation."),
         [](const Row& r) { return topSuccessValue(r); }, [](const Row& r) { return topSuccessText(r); }},
        {tr("Check, learning [%]"),
         tr("Success in the winner's check, in the engine that learned: on the trials that the reference "
            "engine "
            "has simulated, too."),
         [](const Row& r) { return successValue(r, &study::CheckRecord::learning); },
         [](const Row& r) { return successText(r, &study::CheckRecord::learning); }},
        {tr("Check, reference [%]"), tr("Success on the same trials in the reference engine."),
         [](const Row& r) { return successValue(r, &study::CheckRecord::reference); },
         [](const Row& r) { return successText(r, &study::CheckRecord::reference); }},
        {tr("Time [s]"), tr("Wall time that the generation took."),
         [](const Row& r) { return QVariant(r.summary.seconds); },
         [](const Row& r) { return fixed(r.summary.seconds, 1); }},
    };
    for (const objectives::Objective* objective : scoredObjectives(false))
        columns.push_back(scoreColumn<Row>(*objective, &bestOf));
    columns.push_back({tr("F"),
                       tr("Fitness of the winner: the sum that the search maximises. Higher is better."),
                       [](const Row& r) { return QVariant(r.summary.statistics.best.total); },
                       [](const Row& r) { return fixed(r.summary.statistics.best.total, 3); }});
    for (const objectives::Objective* objective : scoredObjectives(true))
        columns.push_back(scoreColumn<Row>(*objective, &bestOf));
    columns.push_back({tr("Mean F of top 30 %"), tr("Mean fitness of the best 30 % of the generation."),
                       [](const Row& r) { return QVariant(r.summary.statistics.topMean.total); },
                       [](const Row& r) { return fixed(r.summary.statistics.topMean.total, 3); }});
    return columns;
}

int GenerationModel::firstDetail() {
    return FirstScore + static_cast<int>(scoredObjectives(false).size());
}

void GenerationModel::setGenerations(const std::vector<study::GenerationSummary>& summaries,
                                     const std::vector<study::CheckRecord>& checks,
                                     const search::MethodInfo& search) {
    std::vector<GenerationRow> rows;
    rows.reserve(summaries.size());
    for (const study::GenerationSummary& summary : summaries)
        rows.push_back({summary, std::nullopt});
    std::vector<Column<GenerationRow>> columns = makeColumns();
    for (const search::NumberInfo& curve : search.curves)
        columns.push_back(
            numberColumn<Row>(curve, [](const Row& r) { return std::span(r.summary.statistics.curves); }));
    reset(std::move(rows), std::move(columns));
    for (const study::CheckRecord& check : checks)
        setCheck(check);
}

void GenerationModel::append(const study::GenerationSummary& summary) {
    appendRow({summary, std::nullopt});
}

void GenerationModel::setCheck(const study::CheckRecord& check) {
    const auto found = std::find_if(rows().begin(), rows().end(), [&](const GenerationRow& row) {
        return row.summary.index == check.generation;
    });
    if (found == rows().end()) return;
    replaceRow(static_cast<int>(found - rows().begin()), {found->summary, check});
}

QVariant GenerationModel::more(const GenerationRow& row, int column, int role) const {
    switch (role) {
        case GenerationRole:
            return row.summary.index;
        case IndividualRole:
            return row.summary.winner;
        case Qt::ToolTipRole: {
            if (column == Generation && row.summary.mendedFrom) {
                return tr("Variants of generation %1, individual %2 that can be printed; nothing was "
                          "learned.")
                    .arg(row.summary.mendedFrom->generation)
                    .arg(row.summary.mendedFrom->individual);
            }
            if (column == Success || column == Bounds) return successHelp(row.summary.statistics.success);
            const bool learning = column == LearningSuccess;
            if (!row.check || !(learning || column == ReferenceSuccess)) return {};
            const study::EngineScore& score = learning ? row.check->learning : row.check->reference;
            return tr("%1: %2 of %3 parts")
                .arg(QString::fromStdString(score.engine))
                .arg(score.oriented)
                .arg(row.check->trials);
        }
        default:
            return {};
    }
}

}  // namespace trapwright::models
