#pragma once

#include <QChartView>
#include <optional>
#include <vector>

#include "ui/charts/chart_theme.h"

class QCategoryAxis;

namespace trapwright::charts {

/// An axis of a map: where its cells are.
struct MapAxis {
    QString title;  // with the unit
    QStringList labels;
};

/// Shares over two conditions as cells with their numbers in them; the more fails, the darker a cell is.
class PairMap : public QChartView {
    Q_OBJECT
 public:
    explicit PairMap(QWidget* parent);

    /// Row by row from below, in percent; `help` likewise, for who points at a cell.
    void setCells(MapAxis across, MapAxis up, std::vector<double> shares, QStringList help);
    void setTheme(const ChartTheme& theme);

    /// In the widget's coordinates; none: beside all cells.
    [[nodiscard]] std::optional<int> cellAt(const QPointF& position) const;
    [[nodiscard]] QRectF cellRect(int cell) const;

 signals:
    void picked(int cell);

 protected:
    bool viewportEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void drawForeground(QPainter* painter, const QRectF& rect) override;

 private:
    [[nodiscard]] int columns() const { return static_cast<int>(across_.labels.size()); }
    [[nodiscard]] int rows() const { return static_cast<int>(up_.labels.size()); }
    void updateTicks();

    MapAxis across_;
    MapAxis up_;
    std::vector<double> shares_;
    QStringList help_;
    ChartTheme theme_;
    QCategoryAxis* xAxis_;
    QCategoryAxis* yAxis_;
};

}  // namespace trapwright::charts
