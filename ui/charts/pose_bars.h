#pragma once

#include <QChartView>
#include <vector>

#include "ui/charts/chart_theme.h"

class QBarCategoryAxis;
class QHorizontalStackedBarSeries;
class QCategoryAxis;

namespace trapwright::charts {

/// One stacked bar.
struct PoseBar {
    QString name;
    std::vector<double> shares;  // slot i of series i [%]
};

/// Shares as horizontal stacked bars with their numbers in them.
class PoseBars : public QChartView {
    Q_OBJECT
 public:
    explicit PoseBars(QWidget* parent);

    /// Top bar first. Slot i of `names` and `colours` is for series i; all bars have a share for each.
    void setBars(std::vector<PoseBar> bars, const QStringList& names,
                 const std::vector<SeriesColour>& colours);
    void setTheme(const ChartTheme& theme);

 protected:
    void resizeEvent(QResizeEvent* event) override;
    void drawForeground(QPainter* painter, const QRectF& rect) override;

 private:
    void updateTicks();
    void updateColours();

    std::vector<PoseBar> bars_;
    QStringList names_;
    std::vector<SeriesColour> colours_;
    ChartTheme theme_;
    QHorizontalStackedBarSeries* series_;
    QBarCategoryAxis* barAxis_;
    QCategoryAxis* shareAxis_;
};

}  // namespace trapwright::charts
