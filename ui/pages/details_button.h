#pragma once

#include <QToolButton>

class QTableView;

namespace trapwright::pages {

/// "Details of the algorithm": while it is pressed, a table shows the columns that only those who look into
/// the algorithm need. Remembered under the table's name. They are in the table's CSV in any case.
class DetailsButton : public QToolButton {
    Q_OBJECT
 public:
    /// The columns from `first` on of a view that has its model.
    DetailsButton(QTableView& view, int first, QWidget* parent);

 protected:
    void changeEvent(QEvent* event) override;

 private:
    void showColumns(bool shown);
    void hideColumns(bool hidden);

    QTableView& view_;
    int first_;
};

}  // namespace trapwright::pages
