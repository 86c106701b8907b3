#pragma once

#include <QWidget>
#include <filesystem>

#include "core/base/result.h"

class QAbstractItemModel;
class QModelIndex;
class QSortFilterProxyModel;
class QStackedLayout;
class QTableView;
class QVBoxLayout;

namespace trapwright::pages {

/// A table of records that sorts by its headings and is saved as CSV; while it has no rows, it says what to
/// do to get some. One row is current: set by the program, or picked by the user.
class RecordTable : public QWidget {
    Q_OBJECT
 public:
    /// `name` is stable and becomes the proposed name of saved files.
    RecordTable(const QString& name, const QString& title, const QString& emptyText,
                QAbstractItemModel& model, QWidget* parent);

    void sortBy(int column, Qt::SortOrder order);
    /// Of the model; -1: none. Not told by picked().
    void setCurrentRow(int row);
    [[nodiscard]] QTableView& view() { return *view_; }
    /// A line above the table.
    void setHead(QWidget* head);

    base::Status saveCsv(const std::filesystem::path& path) const;

 signals:
    /// By the user; of the model.
    void picked(int row);
    void failed(const QString& what, const QString& message);

 private:
    void askAndSaveCsv();
    void updateEmpty();

    QString title_;
    QAbstractItemModel& model_;
    QSortFilterProxyModel* sorted_;
    QTableView* view_;
    QVBoxLayout* column_;
    QStackedLayout* stack_;
    bool setting_ = false;
};

}  // namespace trapwright::pages
