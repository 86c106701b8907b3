#include "ui/models/winner_model.h"

#include <algorithm>
#include <utility>

#include "ui/models/numbers.h"
#include "ui/models/roles.h"

namespace trapwright::models {

WinnerModel::WinnerModel(QObject* parent) : QAbstractListModel(parent) {}

void WinnerModel::setWinners(std::vector<study::Individual> winners) {
    beginResetModel();
    winners_ = std::move(winners);
    pictures_.clear();
    endResetModel();
}

void WinnerModel::append(study::Individual winner) {
    const int at = rowCount();
    beginInsertRows({}, at, at);
    winners_.push_back(std::move(winner));
    endInsertRows();
}

void WinnerModel::setPicture(int generation, const QPixmap& picture) {
    const int row = rowOf(generation);
    if (row < 0) return;
    pictures_.insert(generation, new QPixmap(picture));
    emit dataChanged(index(row), index(row), {Qt::DecorationRole});
}

const study::Individual* WinnerModel::winnerAt(int row) const {
    return row >= 0 && row < rowCount() ? &winners_[static_cast<std::size_t>(row)] : nullptr;
}

int WinnerModel::rowOf(int generation) const {
    const auto found = std::lower_bound(
        winners_.begin(), winners_.end(), generation,
        [](const study::Individual& winner, int wanted) { return winner.generation < wanted; });
    if (found == winners_.end() || found->generation != generation) return -1;
    return static_cast<int>(found - winners_.begin());
}

void WinnerModel::setForgiving(bool isForgiving) {
    if (std::exchange(isForgiving_, isForgiving) == isForgiving || winners_.empty()) return;
    emit dataChanged(index(0), index(static_cast<int>(winners_.size()) - 1));
}

int WinnerModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(winners_.size());
}

QVariant WinnerModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) return {};
    const study::Individual& winner = winners_[static_cast<std::size_t>(index.row())];
    const study::IndividualRecord& record = winner.record;
    switch (role) {
        case Qt::DisplayRole:
            return QString::number(winner.generation);
        case Qt::ToolTipRole:
        case Qt::AccessibleTextRole:
            return (isForgiving_ ? tr("Generation %1, winner: correct %2. %3 of %4 parts finished. F %5")
                                 : tr("Generation %1, winner: success %2. %3 of %4 parts finished. F %5"))
                .arg(winner.generation)
                .arg(shareText(isForgiving_ ? record.correct() : record.success()))
                .arg(record.finished)
                .arg(record.trials)
                .arg(fixed(record.fitness.total, 3));
        case SuccessRole:
            return successWord(isForgiving_ ? record.correct() : record.success());
        case Qt::DecorationRole: {
            const QPixmap* picture = pictures_.object(winner.generation);
            return picture == nullptr ? QVariant() : QVariant(*picture);
        }
        case Qt::TextAlignmentRole:
            return static_cast<int>(Qt::AlignCenter);
        case ValueRole:
            return record.fitness.total;
        case GenerationRole:
            return winner.generation;
        case IndividualRole:
            return winner.individual;
        default:
            return {};
    }
}

}  // namespace trapwright::models
