#pragma once

#include <QSet>
#include <QWidget>

class QAbstractItemModel;
class QHBoxLayout;
class QLabel;
class QModelIndex;
class QStackedLayout;
class QTableView;

namespace trapwright::pages {

/// A table of results with a sentence above it and actions beside that; while it is empty, it says what to
/// do. Numbers in some columns look and work like links, unless they are 0.
class ResultTable : public QWidget {
    Q_OBJECT
 public:
    ResultTable(const QString& name, const QString& title, QAbstractItemModel& model);

    /// `details` come as a tip.
    void setHead(const QString& text, const QString& details = {});
    void setEmptyText(const QString& text);
    void setLinkColumns(const QSet<int>& columns);
    /// So many of the last rows stay in sight below the others: totals.
    void setPinned(int rows);
    /// Where actions go, right of the sentence.
    [[nodiscard]] QHBoxLayout& headRow() { return *head_; }
    [[nodiscard]] QTableView& view() { return *view_; }
    /// The pinned rows; the same model.
    [[nodiscard]] QTableView& pinnedView() { return *foot_; }

 signals:
    /// A cell was clicked, or Enter was pressed on it.
    void cellChosen(const QModelIndex& index);
    void failed(const QString& what, const QString& message);

 private:
    void setUpView(QTableView& view, const QString& name);
    void showEmpty();
    void arrange();
    void askAndSave();

    QAbstractItemModel& model_;
    QLabel* text_;
    QLabel* empty_;
    QHBoxLayout* head_;
    QTableView* view_;
    QTableView* foot_;
    QStackedLayout* stack_;
    int pinned_ = 0;
};

}  // namespace trapwright::pages
