#pragma once

#include <QWidget>
#include <span>

#include "core/study/comparison.h"

class QGridLayout;

namespace trapwright::pages {

/// Studies side by side: how far each is and what its best track scored, while learning and in fresh trials;
/// with several of them median and quartiles below.
class ComparisonTable : public QWidget {
    Q_OBJECT
 public:
    explicit ComparisonTable(QWidget* parent);

    void show(std::span<const study::ComparedStudy> studies);

 private:
    enum class Weight { head, row, sum };
    void addRow(const QStringList& cells, const QString& help, Weight weight);

    QWidget* body_ = nullptr;
    QGridLayout* grid_ = nullptr;
    int rows_ = 0;
};

}  // namespace trapwright::pages
