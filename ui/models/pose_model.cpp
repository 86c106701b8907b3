#include "ui/models/pose_model.h"

#include "ui/models/numbers.h"

namespace trapwright::models {

namespace {

using Row = PoseRow;

constexpr double kPercent = 100.0;

}  // namespace

PoseModel::PoseModel(QObject* parent) : RecordModel(makeColumns(), parent) {}

std::vector<Column<PoseRow>> PoseModel::makeColumns() {
    return {
        {tr("Pose"), tr("Most probable first, counted from 1."),
         [](const Row& r) { return QVariant(r.pose + 1); },
         [](const Row& r) { return QString::number(r.pose + 1); }},
        {tr("Probability [%]"), tr("Of resting like this when dropped at random on a flat."),
         [](const Row& r) { return QVariant(kPercent * r.stable.probability); },
         [](const Row& r) { return fixed(kPercent * r.stable.probability, 1); }},
        {tr("Alike"), tr("Ways to rest that look the same because the part is symmetric."),
         [](const Row& r) { return QVariant(r.stable.multiplicity); },
         [](const Row& r) { return QString::number(r.stable.multiplicity); }},
        {tr("Centre height [mm]"), tr("Of the centre of mass above the flat."),
         [](const Row& r) { return QVariant(r.stable.height / base::kMillimetre); },
         [](const Row& r) { return fixed(r.stable.height / base::kMillimetre, 2); }},
    };
}

void PoseModel::setPart(const part::Part& part) {
    std::vector<PoseRow> rows;
    rows.reserve(part.stablePoses.size());
    for (const part::StablePose& pose : part.stablePoses)
        rows.push_back({static_cast<int>(rows.size()), pose});
    pictures_.clear();
    reset(std::move(rows));
}

void PoseModel::clear() {
    pictures_.clear();
    reset({});
}

void PoseModel::setPicture(int pose, const QPixmap& picture) {
    if (pose < 0 || pose >= rowCount()) return;
    pictures_[pose] = picture;
    emit dataChanged(index(pose, 0), index(pose, 0), {Qt::DecorationRole});
}

QVariant PoseModel::more(const PoseRow& row, int column, int role) const {
    if (role == PoseRole) return row.pose;
    if (role == Qt::DecorationRole && column == Pose) {
        const auto found = pictures_.find(row.pose);
        if (found != pictures_.end()) return found->second;
    }
    return {};
}

}  // namespace trapwright::models
