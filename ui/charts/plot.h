#pragma once

#include <QChartView>
#include <optional>
#include <set>
#include <vector>

#include "ui/charts/axes.h"
#include "ui/charts/chart_theme.h"
#include "ui/charts/sheet.h"

class QCategoryAxis;

namespace trapwright::charts {

/// A point of a scattered curve.
struct PlotPoint {
    std::size_t curve = 0;
    std::size_t index = 0;  // of Curve::points

    friend bool operator==(const PlotPoint&, const PlotPoint&) = default;
};

/// One plot: curves with axes whose ticks are always round. Zooms by wheel (over an axis:
/// along that one), pans by dragging; double click and fit() show everything.
class Plot : public QChartView {
    Q_OBJECT
 public:
    explicit Plot(QWidget* parent);

    void setSheet(const PlotSheet& sheet);
    [[nodiscard]] const PlotSheet& sheet() const { return sheet_; }
    void setTheme(const ChartTheme& theme);
    /// Slot i for curve i; curves beyond are shown.
    void setShown(std::vector<bool> shown);

    /// Everything in view, and so it stays as data come.
    void fit();
    void zoom(double factor);
    [[nodiscard]] bool isFitted() const { return fitted_; }
    void setXRange(const Range& range);
    [[nodiscard]] const Range& xRange() const { return x_; }
    /// log10 of the value on a logarithmic scale.
    [[nodiscard]] const Range& yRange() const { return y_; }

    /// Where values are read off; none: nowhere.
    void setCursor(std::optional<double> x);
    /// So many points on along the topmost curve that has some to pick; from nowhere to its first one.
    void stepPoint(int step);
    /// As a click on it.
    void pickPoint();
    /// The values at the cursor, a line each.
    [[nodiscard]] QStringList readOff() const;

    /// For a picture: no cursor.
    void setPicturing(bool picturing);

    /// In the widget's coordinates. y is the value itself.
    [[nodiscard]] QPointF toWidget(const QPointF& value) const;
    [[nodiscard]] QRectF plotArea() const;

 signals:
    /// By the user, or by fit().
    void xRangeChanged();
    void fitWanted();
    void cursorMoved(std::optional<double> x);
    void picked(double x);
    void pointPicked(std::size_t curve, std::size_t index);

 protected:
    void resizeEvent(QResizeEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void drawForeground(QPainter* painter, const QRectF& rect) override;

 private:
    /// A curve as it is drawn: y is log10 of the value on a logarithmic scale.
    struct DrawnCurve {
        QPolygonF points;
        QPolygonF low;  // of the band; slot i about points[i]
        QPolygonF high;
        bool shown = true;
    };

    [[nodiscard]] double leastWidth() const;
    [[nodiscard]] double toAxis(double value) const;
    [[nodiscard]] QPointF fromWidget(const QPointF& position) const;
    /// The points of a curve that belong together: from the first to the last, and no data are missing
    /// between.
    struct Piece {
        qsizetype first = 0;
        qsizetype last = 0;
    };

    [[nodiscard]] std::vector<Piece> piecesOf(const QPolygonF& points) const;
    [[nodiscard]] QPointF placeOf(const QPointF& point) const;
    void updateCurves();
    void updateLimits();
    void updateView();
    void updateTicks();
    void updateTitle();
    void paintMark(QPainter& painter) const;
    void paintBands(QPainter& painter) const;
    void paintCurves(QPainter& painter) const;
    void paintMarkers(QPainter& painter, std::size_t curve) const;
    void moveCursorTo(const QPointF& position);
    void movePointTo(std::optional<PlotPoint> point);
    [[nodiscard]] std::optional<PlotPoint> findPoint(const QPointF& position) const;
    void paintPoint(QPainter& painter) const;

    PlotSheet sheet_;
    ChartTheme theme_;
    std::vector<DrawnCurve> curves_;  // slot i for curve i of the sheet
    QCategoryAxis* xAxis_;
    QCategoryAxis* yAxis_;
    Range xLimits_;
    Range yLimits_;
    Range x_;
    Range y_;
    bool fitted_ = true;
    bool picturing_ = false;
    std::optional<double> cursor_;
    std::optional<PlotPoint> point_;  // where it is read off by point (PlotSheet::byPoint)
    std::optional<QPointF> pressed_;
    QPointF dragged_;
    bool dragging_ = false;
};

}  // namespace trapwright::charts
