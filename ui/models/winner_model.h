#pragma once

#include <QAbstractListModel>
#include <QCache>
#include <QPixmap>
#include <vector>

#include "core/study/records.h"

namespace trapwright::models {

/// The film strip: the winner of every generation, oldest first, with a picture once there is one.
class WinnerModel : public QAbstractListModel {
    Q_OBJECT
 public:
    /// So many pictures are kept, those that were looked at last: thousands would fill the memory.
    static constexpr int kMostPictures = 256;

    explicit WinnerModel(QObject* parent = nullptr);

    void setWinners(std::vector<study::Individual> winners);
    void append(study::Individual winner);
    /// Whether the share of right ones among those that finish is shown, not among all
    /// (study::forgivesFalls).
    void setForgiving(bool isForgiving);
    /// Shown as decoration. Forgotten by setWinners.
    void setPicture(int generation, const QPixmap& picture);
    [[nodiscard]] bool hasPicture(int generation) const { return pictures_.contains(generation); }

    [[nodiscard]] const std::vector<study::Individual>& winners() const { return winners_; }
    /// Null if there is none in this row.
    [[nodiscard]] const study::Individual* winnerAt(int row) const;
    /// The row of a generation; -1 if it is not there.
    [[nodiscard]] int rowOf(int generation) const;

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

 private:
    std::vector<study::Individual> winners_;
    bool isForgiving_ = false;
    QCache<int, QPixmap> pictures_{kMostPictures};
};

}  // namespace trapwright::models
