#include "ui/models/validation_model.h"

#include <QFont>

#include "core/study/validation.h"
#include "core/work/study_trials.h"
#include "ui/models/numbers.h"

namespace trapwright::models {

namespace {

using Row = ValidationTableRow;

int successes(const Row& row) {
    return row.row.trials - row.row.failures;
}

Row makeRow(const study::ValidationRow& row) {
    return {row, stats::calcClopperPearson(row.trials - row.failures, row.trials)};
}

int verdictOf(int column) {
    switch (column) {
        case ValidationModel::WrongOrientation:
            return static_cast<int>(work::TrialVerdict::wrongOrientation);
        case ValidationModel::Stuck:
            return static_cast<int>(work::TrialVerdict::stuck);
        case ValidationModel::FellOff:
            return static_cast<int>(work::TrialVerdict::fellOff);
        default:
            return -1;
    }
}

}  // namespace

ValidationModel::ValidationModel(QObject* parent) : RecordModel(makeColumns(), parent) {}

std::vector<Column<ValidationTableRow>> ValidationModel::makeColumns() {
    return {
        {tr("Pose"), tr("Stable pose near which the parts began, counted from 1."),
         [](const Row& r) { return r.row.pose < 0 ? QVariant(tr("Total")) : QVariant(r.row.pose + 1); },
         [](const Row& r) { return r.row.pose < 0 ? tr("Total") : QString::number(r.row.pose + 1); }},
        {tr("Trials"), tr("Simulated trials (T)."), [](const Row& r) { return QVariant(r.row.trials); },
         [](const Row& r) { return QString::number(r.row.trials); }},
        {tr("Failures"), tr("Parts that did not finish in the expected orientation (F)."),
         [](const Row& r) { return QVariant(r.row.failures); },
         [](const Row& r) { return QString::number(r.row.failures); }},
        {tr("Success [%]"), tr("Parts that finished in the expected orientation (P)."),
         [](const Row& r) { return percentValue(successes(r), r.row.trials); },
         [](const Row& r) { return percent(successes(r), r.row.trials); }},
        {tr("95 % bounds [%]"), boundsHelp() + u' ' + tr("Sorted by the lower bound."),
         [](const Row& r) { return QVariant(100.0 * r.bounds.low); },
         [](const Row& r) { return boundsText(r.bounds, r.row.trials); },
         [] { return boundsTitles(tr("Success")); },
         [](const Row& r) { return boundsValues(r.bounds, r.row.trials); }},
        {tr("Wrong"), tr("Parts that finished in another orientation."),
         [](const Row& r) { return QVariant(r.row.wrongOrientation); },
         [](const Row& r) { return QString::number(r.row.wrongOrientation); }},
        {tr("Stuck"), tr("Parts that got stuck or ran out of time."),
         [](const Row& r) { return QVariant(r.row.stuck); },
         [](const Row& r) { return QString::number(r.row.stuck); }},
        {tr("Fell"), tr("Parts that fell off the track."),
         [](const Row& r) { return QVariant(r.row.fellOff); },
         [](const Row& r) { return QString::number(r.row.fellOff); }},
    };
}

void ValidationModel::setValidation(const study::ValidationRecord& record) {
    std::vector<Row> rows;
    rows.reserve(record.rows.size() + 1);
    for (const study::ValidationRow& row : record.rows)
        rows.push_back(makeRow(row));
    rows.push_back(makeRow(study::calcTotal(record)));
    reset(std::move(rows));
}

void ValidationModel::clear() {
    reset({});
}

QVariant ValidationModel::more(const ValidationTableRow& row, int column, int role) const {
    if (role == PoseRole) return row.row.pose;
    if (role == VerdictRole) return verdictOf(column);
    if (role == Qt::FontRole && row.row.pose < 0) {
        QFont font;
        font.setBold(true);
        return font;
    }
    return {};
}

}  // namespace trapwright::models
