#include "ui/models/trial_model.h"

#include <algorithm>

#include "ui/models/numbers.h"
#include "ui/models/verdict_look.h"

namespace trapwright::models {

namespace {

using Row = TrialRow;

}  // namespace

TrialModel::TrialModel(QObject* parent) : RecordModel(makeColumns(), parent) {}

std::vector<Column<TrialRow>> TrialModel::makeColumns() {
    return {
        {tr("Trial"), tr("Counted from 0."), [](const Row& r) { return QVariant(r.trial); },
         [](const Row& r) { return QString::number(r.trial); }},
        {tr("Outcome"), tr("How the trial ended."),
         [](const Row& r) { return QVariant(verdictText(r.verdict)); },
         [](const Row& r) { return verdictWord(r.verdict); }},
        {tr("Start pose"), tr("Stable pose in which the part began, counted from 1."),
         [](const Row& r) { return r.pose < 0 ? QVariant() : QVariant(r.pose + 1); },
         [](const Row& r) { return r.pose < 0 ? tr("any") : QString::number(r.pose + 1); }},
        {tr("Off [°]"), tr("Angle between the part at the finish and the expected orientation."),
         [](const Row& r) { return r.angle ? QVariant(*r.angle / base::kDegree) : QVariant(); },
         [](const Row& r) { return r.angle ? fixed(*r.angle / base::kDegree, 1) : QString(); }},
        {tr("Time [s]"), tr("Simulated time until the trial ended."),
         [](const Row& r) { return QVariant(r.outcome.time); },
         [](const Row& r) { return fixed(r.outcome.time, 2); }},
        {tr("Reached [mm]"), tr("The farthest that the part came along the track."),
         [](const Row& r) { return QVariant(r.outcome.farthest.position.x() / base::kMillimetre); },
         [](const Row& r) { return fixed(r.outcome.farthest.position.x() / base::kMillimetre, 1); }},
    };
}

void TrialModel::setTrials(std::vector<TrialRow> rows) {
    reset(std::move(rows));
}

int TrialModel::count(trial::Verdict verdict) const {
    return static_cast<int>(std::count_if(rows().begin(), rows().end(),
                                          [&](const TrialRow& row) { return row.verdict == verdict; }));
}

int TrialModel::rowOf(int trial) const {
    const auto row = std::ranges::lower_bound(rows(), trial, {}, &TrialRow::trial);
    return row != rows().end() && row->trial == trial ? static_cast<int>(row - rows().begin()) : -1;
}

QVariant TrialModel::more(const TrialRow& row, int column, int role) const {
    switch (role) {
        case TrialRole:
            return row.trial;
        case PoseRole:
            return row.pose;
        case VerdictRole:
            return static_cast<int>(row.verdict);
        case Qt::DecorationRole:
            return column == Verdict ? QVariant(verdictIcon(row.verdict)) : QVariant();
        default:
            return {};
    }
}

TrialFilter::TrialFilter(QObject* parent)
    : QSortFilterProxyModel(parent), verdicts_(kVerdicts.begin(), kVerdicts.end()) {
    setSortRole(ValueRole);
}

void TrialFilter::setVerdicts(std::set<trial::Verdict> verdicts) {
    verdicts_ = std::move(verdicts);
    invalidateFilter();
}

void TrialFilter::setPose(std::optional<int> pose) {
    pose_ = pose;
    invalidateFilter();
}

bool TrialFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
    const QModelIndex index = sourceModel()->index(row, 0, parent);
    const auto verdict = static_cast<trial::Verdict>(index.data(VerdictRole).toInt());
    return verdicts_.contains(verdict) && (!pose_ || index.data(PoseRole).toInt() == *pose_);
}

}  // namespace trapwright::models
