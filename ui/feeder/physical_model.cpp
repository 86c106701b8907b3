#include "ui/feeder/physical_model.h"

#include <functional>

#include <QFont>

#include "ui/models/numbers.h"

namespace trapwright::feeder {

namespace {

using Row = study::PhysicalRow;
using study::SuccessCount;

constexpr double kPercent = 100.0;
constexpr double kLeastShown = 0.001;

/// Of the weighted total no trials are counted.
template <auto count, SuccessCount Row::*side>
QVariant countOf(const Row& row) {
    return row.weighted ? QVariant() : QVariant(std::invoke(count, (row.*side).tally));
}

template <auto count, SuccessCount Row::*side>
QString countText(const Row& row) {
    if (row.weighted) return {};
    return (row.*side).tally.trials() == 0 ? QStringLiteral("–")
                                           : QString::number(std::invoke(count, (row.*side).tally));
}

template <SuccessCount Row::*side>
QVariant success(const Row& row) {
    return models::percentValue((row.*side).rate);
}

template <SuccessCount Row::*side>
QString successText(const Row& row) {
    return models::percent((row.*side).rate);
}

template <SuccessCount Row::*side>
QVariant bounds(const Row& row) {
    return kPercent * (row.*side).bounds.low;
}

template <SuccessCount Row::*side>
QString boundsText(const Row& row) {
    return models::boundsText((row.*side).bounds, (row.*side).tally.trials());
}

template <SuccessCount Row::*side>
QVariantList boundsValues(const Row& row) {
    return models::boundsValues((row.*side).bounds, (row.*side).tally.trials());
}

QString poseText(const Row& row) {
    if (row.weighted) return PhysicalModel::tr("Weighted");
    return row.poses.empty() ? PhysicalModel::tr("All alike") : models::poseNumbers(row.poses);
}

QString helpOf(const Row& row) {
    if (row.weighted) {
        return PhysicalModel::tr(
            "These poses together, weighted by how often parts land so. Bounds: exact "
            "profile limits.");
    }
    if (row.poses.empty()) return PhysicalModel::tr("All trials alike, however often parts land so.");
    QString lands =
        PhysicalModel::tr("%1 % of all parts land so.").arg(models::fixed(kPercent * row.weight, 1));
    if (row.poses.size() == 1) return lands;
    return lands + u' ' +
           PhysicalModel::tr("%n poses that look the same: the part is symmetric.", nullptr,
                             static_cast<int>(row.poses.size()));
}

QString differenceText(const Row& row) {
    if (row.weighted) return {};
    if (!row.p) return QStringLiteral("–");
    if (*row.p < kLeastShown) return QStringLiteral("< %1").arg(kLeastShown);
    return models::fixed(*row.p, 3);
}

}  // namespace

PhysicalModel::PhysicalModel(QObject* parent) : RecordModel(makeColumns(), parent) {}

std::vector<models::Column<Row>> PhysicalModel::makeColumns() {
    constexpr auto kSimulated = &Row::simulated;
    constexpr auto kReal = &Row::physical;
    return {
        {tr("Pose"),
         tr("Stable poses in which the parts were placed, counted from 1; those that look the same are one "
            "row."),
         [](const Row& r) { return QVariant(poseText(r)); }, &poseText},
        {tr("Sim. T"), tr("Simulated trials (T)."), &countOf<&trial::Tally::trials, kSimulated>,
         &countText<&trial::Tally::trials, kSimulated>},
        {tr("F"), tr("Simulated parts that did not finish in the expected orientation (F)."),
         &countOf<&trial::Tally::failures, kSimulated>, &countText<&trial::Tally::failures, kSimulated>},
        {tr("P [%]"), tr("Simulated parts that finished in the expected orientation (P)."),
         &success<kSimulated>, &successText<kSimulated>},
        {tr("Bounds [%]"), models::boundsHelp(), &bounds<kSimulated>, &boundsText<kSimulated>,
         [] { return models::boundsTitles(tr("Simulated success")); }, &boundsValues<kSimulated>},
        {tr("Feeder T"), tr("Trials on the feeder (T)."), &countOf<&trial::Tally::trials, kReal>,
         [](const Row& r) { return r.weighted ? QString() : QString::number(r.physical.tally.trials()); }},
        {tr("of"), tr("Trials on the feeder that are planned."),
         [](const Row& r) { return r.weighted ? QVariant() : QVariant(r.planned); },
         [](const Row& r) { return r.weighted ? QString() : QString::number(r.planned); }},
        {tr("F"), tr("Parts that failed on the feeder (F)."), &countOf<&trial::Tally::failures, kReal>,
         &countText<&trial::Tally::failures, kReal>},
        {tr("P [%]"), tr("Parts that succeeded on the feeder (P)."), &success<kReal>, &successText<kReal>},
        {tr("Bounds [%]"), models::boundsHelp(), &bounds<kReal>, &boundsText<kReal>,
         [] { return models::boundsTitles(tr("Success on the feeder")); }, &boundsValues<kReal>},
        {tr("Wrong"), tr("Parts that ended in another orientation on the feeder."),
         &countOf<&trial::Tally::wrongOrientation, kReal>,
         &countText<&trial::Tally::wrongOrientation, kReal>},
        {tr("Stuck"), tr("Parts that got stuck on the feeder."), &countOf<&trial::Tally::stuck, kReal>,
         &countText<&trial::Tally::stuck, kReal>},
        {tr("Fell"), tr("Parts that fell off the track on the feeder."),
         &countOf<&trial::Tally::fellOff, kReal>, &countText<&trial::Tally::fellOff, kReal>},
        {tr("p"),
         tr("How probable a difference as large as this one would be if the simulated and the feeder's rates "
            "were equal; "
            "exact test, for the number of poses adjusted."),
         [](const Row& r) { return r.p && !r.weighted ? QVariant(*r.p) : QVariant(); }, &differenceText},
    };
}

void PhysicalModel::setTable(const study::PhysicalTable& table) {
    std::vector<Row> rows = table.rows;
    rows.push_back(table.weighted);
    rows.push_back(table.total);
    reset(std::move(rows));
}

void PhysicalModel::clear() {
    reset({});
}

QVariant PhysicalModel::more(const Row& row, int column, int role) const {
    if (role == Qt::ToolTipRole) return column == Pose ? helpOf(row) : QString();
    if (role != Qt::FontRole || (!row.poses.empty() && column != Success)) return {};
    QFont font;
    font.setBold(true);
    return font;
}

}  // namespace trapwright::feeder
