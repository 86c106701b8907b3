#include "ui/models/selection_model.h"

#include <algorithm>

#include "ui/models/number_columns.h"
#include "ui/models/numbers.h"

namespace trapwright::models {

namespace {

using Row = SelectionRow;

const objectives::Fitness& fitnessOf(const Row& row) {
    return row.entry.fitness;
}

/// Of the corners that were measured last; none if this track was not.
std::optional<stats::Count> findWorstCorner(const study::IndividualId& track,
                                            std::span<const study::RobustnessRecord> measured) {
    const auto known = std::ranges::find_if(
        measured, [&](const study::RobustnessRecord& one) { return isSameIndividual(one, track); });
    if (known == measured.end() || known->robustness.corners.empty()) return std::nullopt;
    const trial::Tally& worst = known->robustness.corners.front().tally;
    return stats::Count{worst.success, worst.trials()};
}

}  // namespace

SelectionModel::SelectionModel(QObject* parent) : RecordModel(makeColumns(), parent) {}

std::vector<Column<SelectionRow>> SelectionModel::makeColumns() {
    std::vector<Column<Row>> columns = {
        {tr("Rank"), tr("1 is the best."), [](const Row& r) { return QVariant(r.rank); },
         [](const Row& r) { return QString::number(r.rank); }},
        {tr("Generation"), tr("The generation that this track is of."),
         [](const Row& r) { return QVariant(r.entry.generation); },
         [](const Row& r) { return QString::number(r.entry.generation); }},
        {tr("Individual"), tr("Its number within the generation."),
         [](const Row& r) { return QVariant(r.entry.individual); },
         [](const Row& r) { return QString::number(r.entry.individual); }},
        {tr("Success [%]"),
         tr("Parts that finished in the expected orientation: this track's most frequent one."),
         [](const Row& r) { return percentValue(r.entry.oriented, r.entry.trials); },
         [](const Row& r) { return percent(r.entry.oriented, r.entry.trials); }},
        {tr("Bounds [%]"), boundsHelp() + u' ' + tr("Sorted by the lower bound."),
         [](const Row& r) { return QVariant(100.0 * r.bounds.low); },
         [](const Row& r) { return boundsText(r.bounds, r.entry.trials); },
         [] { return boundsTitles(tr("Success")); },
         [](const Row& r) { return boundsValues(r.bounds, r.entry.trials); }},
        {tr("In corners [%]"),
         tr("The same of parts in corners of the operating box, where every condition is at an end of its "
            "range.") +
             u' ' + boundsHelp(),
         [](const Row& r) { return percentValue(r.entry.corners.successes, r.entry.corners.trials); },
         [](const Row& r) {
             const stats::Count& corners = r.entry.corners;
             QString share = percent(corners.successes, corners.trials);
             if (corners.trials > 0) share += QString(" (%1)").arg(boundsText(r.corners, corners.trials));
             return share;
         },
         [] { return QStringList{tr("In corners [%]")} + boundsTitles(tr("In corners")); },
         [](const Row& r) {
             const stats::Count& corners = r.entry.corners;
             return QVariantList{percentValue(corners.successes, corners.trials)} +
                    boundsValues(r.corners, corners.trials);
         }},
        {tr("Worst corner [%]"),
         tr("The same in the one corner of the operating box that is worst for this track, if its robustness "
            "was measured.") +
             u' ' + boundsHelp(),
         [](const Row& r) { return percentValue(r.worst); },
         [](const Row& r) {
             return r.worst ? QString("%1 (%2)").arg(percent(r.worst), boundsText(r.worst))
                            : percent(r.worst);
         },
         [] { return QStringList{tr("Worst corner [%]")} + boundsTitles(tr("Worst corner")); },
         [](const Row& r) {
             const stats::Count worst = r.worst.value_or(stats::Count());
             return QVariantList{percentValue(r.worst)} +
                    boundsValues(stats::calcClopperPearson(worst.successes, worst.trials), worst.trials);
         }},
        {tr("Trials"), tr("Fresh simulated trials."), [](const Row& r) { return QVariant(r.entry.trials); },
         [](const Row& r) { return QString::number(r.entry.trials); }},
        {tr("Finished"), tr("Parts that crossed the finish line, in whatever orientation."),
         [](const Row& r) { return QVariant(r.entry.finished); },
         [](const Row& r) { return QString::number(r.entry.finished); }},
    };
    for (const bool isDetail : {false, true}) {
        for (const objectives::Objective* objective : scoredObjectives(isDetail, true))
            columns.push_back(scoreColumn<Row>(*objective, &fitnessOf));
    }
    return columns;
}

int SelectionModel::firstDetail() {
    return FirstScore + static_cast<int>(scoredObjectives(false, true).size());
}

void SelectionModel::setSelection(const study::SelectionRecord& record,
                                  std::span<const study::RobustnessRecord> measured) {
    std::vector<SelectionRow> rows;
    rows.reserve(record.entries.size());
    for (const study::SelectionEntry& entry : record.entries) {
        rows.push_back({static_cast<int>(rows.size()) + 1, entry,
                        stats::calcClopperPearson(entry.oriented, entry.trials),
                        stats::calcClopperPearson(entry.corners.successes, entry.corners.trials),
                        findWorstCorner(entry, measured)});
    }
    reset(std::move(rows));
}

void SelectionModel::clear() {
    reset({});
}

QVariant SelectionModel::more(const SelectionRow& row, int, int role) const {
    if (role == GenerationRole) return row.entry.generation;
    if (role == IndividualRole) return row.entry.individual;
    return {};
}

}  // namespace trapwright::models
