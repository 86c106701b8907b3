#pragma once

#include <QAbstractButton>

#include "ui/charts/chart_theme.h"
#include "ui/charts/sheet.h"

namespace trapwright::charts {

/// An entry of a legend: a sample of its curves and its name, both faint while it is off; what chooses a plot
/// has a check box for a sample.
class LegendItem : public QAbstractButton {
    Q_OBJECT
 public:
    LegendItem(const LegendEntry& entry, QWidget* parent);

    void setTheme(const ChartTheme& theme);

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
    void paintEvent(QPaintEvent* event) override;

 private:
    [[nodiscard]] int sampleWidth() const;
    void paintBox(QPainter& painter) const;

    LegendEntry entry_;
    ChartTheme theme_;
};

}  // namespace trapwright::charts
