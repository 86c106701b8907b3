#include "ui/models/individual_model.h"

#include <QFont>

#include "ui/models/number_columns.h"
#include "ui/models/numbers.h"

namespace trapwright::models {

namespace {

using Row = IndividualRow;

const objectives::Fitness& fitnessOf(const Row& row) {
    return row.record.fitness;
}

}  // namespace

IndividualModel::IndividualModel(QObject* parent) : RecordModel(makeColumns(), parent) {}

std::vector<Column<IndividualRow>> IndividualModel::makeColumns() {
    std::vector<Column<Row>> columns = {
        {tr("Individual"), tr("Counted from 0; the winner is bold."),
         [](const Row& r) { return QVariant(r.individual); },
         [](const Row& r) { return QString::number(r.individual); }},
        {tr("Success [%]"), tr("Parts that finished in the expected orientation, of all trials."),
         [](const Row& r) { return percentValue(r.record.success()); },
         [](const Row& r) { return percent(r.record.success()); }},
        {tr("Bounds [%]"), boundsHelp() + u' ' + tr("Sorted by the lower bound."),
         [](const Row& r) { return boundsValues(r.record.success()).front(); },
         [](const Row& r) { return boundsText(r.record.success()); },
         [] { return boundsTitles(tr("Success")); },
         [](const Row& r) { return boundsValues(r.record.success()); }},
        {tr("Trials"), tr("Simulated trials; 0 if the surface overlaps itself and was not simulated."),
         [](const Row& r) { return QVariant(r.record.trials); },
         [](const Row& r) { return QString::number(r.record.trials); }},
        {tr("Finished"), tr("Parts that crossed the finish line, in whatever orientation."),
         [](const Row& r) { return QVariant(r.record.finished); },
         [](const Row& r) { return QString::number(r.record.finished); }},
        {tr("Stuck"), tr("Parts that got stuck or ran out of time."),
         [](const Row& r) { return QVariant(r.record.stuck); },
         [](const Row& r) { return QString::number(r.record.stuck); }},
        {tr("Fell"), tr("Parts that fell off the track."),
         [](const Row& r) { return QVariant(r.record.fellOff); },
         [](const Row& r) { return QString::number(r.record.fellOff); }},
    };
    for (const objectives::Objective* objective : scoredObjectives(false))
        columns.push_back(scoreColumn<Row>(*objective, &fitnessOf));
    columns.push_back({tr("F"), tr("Fitness: the sum that the search maximises. Higher is better."),
                       [](const Row& r) { return QVariant(r.record.fitness.total); },
                       [](const Row& r) { return fixed(r.record.fitness.total, 3); }});
    for (const objectives::Objective* objective : scoredObjectives(true))
        columns.push_back(scoreColumn<Row>(*objective, &fitnessOf));
    return columns;
}

int IndividualModel::firstDetail() {
    return FirstScore + static_cast<int>(scoredObjectives(false).size());
}

void IndividualModel::setGeneration(const study::GenerationRecord& record, const search::MethodInfo& search) {
    std::vector<IndividualRow> rows;
    rows.reserve(record.individuals.size());
    for (std::size_t i = 0; i < record.individuals.size(); ++i) {
        const int number = static_cast<int>(i);
        rows.push_back({{{record.index, number}, record.individuals[i]}, number == record.winner});
    }
    std::vector<Column<IndividualRow>> columns = makeColumns();
    for (const search::NumberInfo& trait : search.traits)
        columns.push_back(numberColumn<Row>(trait, [](const Row& r) { return std::span(r.record.traits); }));
    reset(std::move(rows), std::move(columns));
}

void IndividualModel::clear() {
    reset({});
}

QVariant IndividualModel::more(const IndividualRow& row, int column, int role) const {
    switch (role) {
        case Qt::ToolTipRole:
            return column == Success || column == Bounds ? successHelp(row.record.success()) : QVariant();
        case GenerationRole:
            return row.generation;
        case IndividualRole:
            return row.individual;
        case IsWinnerRole:
            return row.winner;
        case Qt::FontRole: {
            if (!row.winner) return {};
            QFont font;
            font.setBold(true);
            return font;
        }
        case Qt::AccessibleDescriptionRole:
            return row.winner ? tr("Winner of the generation") : QVariant();
        default:
            return {};
    }
}

}  // namespace trapwright::models
