#include "ui/models/validation_model.h"

#include <QFont>
#include <QPixmap>
#include <algorithm>
#include <functional>
#include <utility>

#include "core/stats/binomial.h"
#include "core/workflow/study_trials.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/models/numbers.h"

namespace trapwright::models {

namespace {

using Row = ValidationTableRow;

constexpr double kPercent = 100.0;
constexpr int kIcon = 12;

Row makeRow(Row::Kind kind, std::vector<int> poses, const study::ValidationRow& row) {
    Row made;
    made.kind = kind;
    made.poses = std::move(poses);
    made.row = row;
    const int good = row.tally.success;
    const int trials = row.tally.trials();
    if (trials > 0) made.rate = static_cast<double>(good) / trials;
    made.bounds = stats::calcClopperPearson(good, trials);
    return made;
}

QString nameOf(const Row& row) {
    switch (row.kind) {
        case Row::Kind::weighted:
            return ValidationModel::tr("Weighted");
        case Row::Kind::correct:
            return ValidationModel::tr("Correct");
        case Row::Kind::total:
            return ValidationModel::tr("All alike");
        case Row::Kind::pose:
            return QStringLiteral("    ") + poseNumbers(row.poses);
        case Row::Kind::condition:
            return QString("%1 %2").arg(row.condition, row.range);
        case Row::Kind::slice:
            return QStringLiteral("    ") + row.range;
        case Row::Kind::group:
            break;
    }
    return poseNumbers(row.poses);
}

QString helpOf(const Row& row) {
    switch (row.kind) {
        case Row::Kind::weighted:
            return ValidationModel::tr(
                "All poses together, weighted by how often parts land so: the share of parts that come as "
                "they fall. Bounds: exact profile limits.");
        case Row::Kind::correct:
            return ValidationModel::tr(
                "Of the parts that arrive, weighted likewise, those in the expected orientation: what falls "
                "off comes again. Bounds: Korn and Graubard.");
        case Row::Kind::total:
            return ValidationModel::tr(
                "All trials alike, however often parts land so. Bounds: Clopper and Pearson.");
        case Row::Kind::condition:
            return ValidationModel::tr(
                "The quarter of this condition's range in which most fails, all others varying; opens to all "
                "four.");
        case Row::Kind::slice:
            return ValidationModel::tr(
                "The trials in this quarter of the range, all other conditions varying.");
        case Row::Kind::pose:
            return {};
        case Row::Kind::group:
            break;
    }
    return row.opens ? ValidationModel::tr("%n poses that look the same: the part is symmetric", nullptr,
                                           static_cast<int>(row.poses.size()))
                     : QString();
}

bool isOfCondition(const Row& row) {
    return row.kind == Row::Kind::condition || row.kind == Row::Kind::slice;
}

/// Of totals that are weighted no trials are counted.
bool isWeighted(const Row& row) {
    return row.kind == Row::Kind::weighted || row.kind == Row::Kind::correct;
}

template <auto count>
QVariant countOf(const Row& row) {
    return isWeighted(row) ? QVariant() : QVariant(std::invoke(count, row.row.tally));
}

template <auto count>
QString countText(const Row& row) {
    return isWeighted(row) ? QString() : QString::number(std::invoke(count, row.row.tally));
}

/// Keeps names in line with those that have a sign before them.
QVariant transparentIcon() {
    QPixmap nothing(kIcon, kIcon);
    nothing.fill(Qt::transparent);
    return nothing;
}

int verdictOf(int column) {
    switch (column) {
        case ValidationModel::WrongOrientation:
            return static_cast<int>(trial::Verdict::wrongOrientation);
        case ValidationModel::Stuck:
            return static_cast<int>(trial::Verdict::stuck);
        case ValidationModel::FellOff:
            return static_cast<int>(trial::Verdict::fellOff);
        default:
            return -1;
    }
}

}  // namespace

ValidationModel::ValidationModel(QObject* parent) : RecordModel(makeColumns(), parent) {}

std::vector<Column<ValidationTableRow>> ValidationModel::makeColumns() {
    using trial::Tally;
    return {
        {tr("Pose"),
         tr("Stable poses near which the parts began, counted from 1; those that look the same are one row. "
            "Below them the same trials by the conditions that they varied over."),
         [](const Row& r) { return QVariant(nameOf(r).trimmed()); }, &nameOf},
        {tr("Share [%]"), tr("How often parts land in this pose."),
         [](const Row& r) { return percentValue(r.weight); },
         [](const Row& r) { return r.weight ? fixed(kPercent * *r.weight, 1) : QString(); }},
        {tr("Trials"), tr("Simulated trials (T)."), &countOf<&Tally::trials>, &countText<&Tally::trials>},
        {tr("Failed"), tr("Parts that did not finish in the expected orientation (F)."),
         &countOf<&Tally::failures>, &countText<&Tally::failures>},
        {tr("Success [%]"), tr("Parts that finished in the expected orientation (P)."),
         [](const Row& r) { return percentValue(r.rate); }, [](const Row& r) { return percent(r.rate); }},
        {tr("Bounds [%]"), boundsHelp() + u' ' + tr("Sorted by the lower bound."),
         [](const Row& r) { return QVariant(kPercent * r.bounds.low); },
         [](const Row& r) { return boundsText(r.bounds, r.row.tally.trials()); },
         [] { return boundsTitles(tr("Success")); },
         [](const Row& r) { return boundsValues(r.bounds, r.row.tally.trials()); }},
        {tr("Wrong"), tr("Parts that finished in another orientation."), &countOf<&Tally::wrongOrientation>,
         &countText<&Tally::wrongOrientation>},
        {tr("Stuck"), tr("Parts that got stuck or ran out of time."), &countOf<&Tally::stuck>,
         &countText<&Tally::stuck>},
        {tr("Fell"), tr("Parts that fell off the track."), &countOf<&Tally::fellOff>,
         &countText<&Tally::fellOff>},
    };
}

void ValidationModel::setValidation(const study::ValidationTable& table) {
    table_ = table;
    refill();
}

void ValidationModel::refill() {
    std::vector<Row> rows;
    anyOpens_ = false;
    for (const study::ValidationGroup& group : table_.groups) {
        Row& row = rows.emplace_back(makeRow(Row::Kind::group, group.poses, group.sum));
        row.weight = group.weight;
        row.opens = group.rows.size() > 1;
        row.open = row.opens && open_.contains(group.poses);
        anyOpens_ = anyOpens_ || row.opens;
        if (!row.open) continue;
        for (const study::ValidationRow& one : group.rows)
            rows.push_back(makeRow(Row::Kind::pose, {one.pose}, one));
    }
    addConditions(rows);
    anyOpens_ = anyOpens_ || !conditions_.empty();
    totals_ = 1;
    const auto addWeighted = [&](Row::Kind kind, const stats::WeightedRate& weighted) {
        if (!weighted.rate) return;
        Row& row = rows.emplace_back(makeRow(kind, {}, table_.total));
        row.rate = weighted.rate;
        row.bounds = weighted.interval;
        ++totals_;
    };
    addWeighted(Row::Kind::weighted, table_.weighted);
    addWeighted(Row::Kind::correct, table_.correct);
    rows.push_back(makeRow(Row::Kind::total, {}, table_.total));
    reset(std::move(rows));
}

void ValidationModel::addConditions(std::vector<Row>& rows) const {
    for (const study::SlicedCondition& sliced : conditions_) {
        const std::string_view title =
            trial::conditionTexts()[static_cast<std::size_t>(sliced.condition)].name;
        const QString name = look::fromUtf8(title);
        const auto makeSlice = [&](Row::Kind kind, const study::ConditionSlice& slice) {
            Row row = makeRow(kind, {}, {-1, slice.tally});
            row.condition = name;
            row.slice = slice.places;
            row.range = QString::fromStdString(study::describeRange(sliced.condition, slice));
            row.range.replace(" ... ", "…").replace(" deg", "°");
            return row;
        };
        const auto rateOf = [](const study::ConditionSlice& slice) {
            return slice.tally.success / std::max(1.0, static_cast<double>(slice.tally.trials()));
        };
        const bool open = openConditions_.contains(name);
        Row& row = rows.emplace_back(
            makeSlice(Row::Kind::condition, *std::ranges::min_element(sliced.slices, {}, rateOf)));
        row.opens = true;
        row.open = open;
        if (!open) continue;
        for (const study::ConditionSlice& slice : sliced.slices)
            rows.push_back(makeSlice(Row::Kind::slice, slice));
    }
}

void ValidationModel::setConditions(std::vector<study::SlicedCondition> conditions) {
    conditions_ = std::move(conditions);
    if (!table_.groups.empty()) refill();
}

void ValidationModel::toggle(int row) {
    if (row < 0 || row >= rowCount() || !rows()[static_cast<std::size_t>(row)].opens) return;
    const Row& chosen = rows()[static_cast<std::size_t>(row)];
    if (chosen.kind == Row::Kind::condition) {
        const QString name = chosen.condition;
        if (openConditions_.erase(name) == 0) openConditions_.insert(name);
        return refill();
    }
    const std::vector<int> poses = chosen.poses;
    if (open_.erase(poses) == 0) open_.insert(poses);
    refill();
}

void ValidationModel::clear() {
    table_ = {};
    conditions_.clear();
    totals_ = 0;
    reset({});
}

QVariant ValidationModel::more(const ValidationTableRow& row, int column, int role) const {
    const bool total = row.poses.empty() && !isOfCondition(row);
    switch (role) {
        case VerdictRole:
            return isWeighted(row) ? -1 : verdictOf(column);
        case Qt::ToolTipRole:
            return column == Pose ? helpOf(row) : QString();
        case Qt::DecorationRole:
            if (column != Pose || !anyOpens_ || total) return {};
            if (row.opens) return look::icon(row.open ? "unfold" : "fold");
            return transparentIcon();
        case Qt::FontRole:
            if (total) {
                QFont font;
                font.setBold(true);
                return font;
            }
            return {};
        default:
            return {};
    }
}

}  // namespace trapwright::models
