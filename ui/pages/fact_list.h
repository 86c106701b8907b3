#pragma once

#include <QString>
#include <QWidget>
#include <utility>
#include <vector>

class QGridLayout;
class QLabel;

namespace trapwright::pages {

using Facts = std::vector<std::pair<QString, QString>>;

/// Names and values, one pair below the other; values can be selected and copied.
class FactList : public QWidget {
    Q_OBJECT
 public:
    explicit FactList(QWidget* parent);

    /// Cheap where there are as many as before.
    void show(const Facts& facts);

 private:
    void addRow();

    QGridLayout* grid_;
    std::vector<std::pair<QLabel*, QLabel*>> rows_;
};

}  // namespace trapwright::pages
