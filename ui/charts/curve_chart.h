#pragma once

#include <optional>
#include <vector>

#include "ui/charts/chart_panel.h"
#include "ui/charts/sheet.h"

class QHBoxLayout;

namespace trapwright::charts {

class Plot;

/// Plots side by side over the same whole numbers (generations). Wheel zooms about the cursor, dragging pans,
/// a double click shows everything again; a cursor reads the values off, by mouse or arrow keys. What is
/// shown follows new data until the user zooms.
class CurveChart : public ChartPanel {
    Q_OBJECT
 public:
    CurveChart(const QString& name, const QString& title, QWidget* parent);

    /// Cheap for the same plots and curves with more points.
    void setSheet(ChartSheet sheet);
    [[nodiscard]] const ChartSheet& sheet() const { return sheet_; }

    [[nodiscard]] QString csv() const override;

    /// Switches a legend entry as the user would.
    void setShown(const QString& key, bool shown);

    void fit();
    void zoom(double factor);
    /// The cursor at this x in all plots; none: no cursor.
    void setCursor(std::optional<double> x);
    [[nodiscard]] std::optional<double> cursor() const { return cursor_; }

    /// The plots in view, left to right.
    [[nodiscard]] std::vector<Plot*> shownPlots() const;

 signals:
    /// A generation was clicked.
    void picked(int x);
    /// A point of a scattered curve was clicked, of the plot that reads off by point.
    void pointPicked(std::size_t curve, std::size_t index);

 protected:
    void applyTheme(const ChartTheme& theme) override;

 private:
    void addActions();
    void updateShown();
    void stepCursor(int step);
    void linkPlot(Plot* plot);

    ChartSheet sheet_;
    QWidget* row_;
    QHBoxLayout* layout_;
    std::vector<Plot*> plots_;
    std::optional<double> cursor_;
};

}  // namespace trapwright::charts
