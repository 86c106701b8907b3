#pragma once

#include <QLabel>

namespace trapwright::pages {

/// What a panel says above its chart, in sentences with links. It lays the panel out: itself, then the chart.
class PanelHead : public QLabel {
    Q_OBJECT
 public:
    PanelHead(const QString& name, QWidget* panel, QWidget* chart);
};

}  // namespace trapwright::pages
