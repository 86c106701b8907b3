#pragma once

#include <QPointF>
#include <QString>
#include <QStringList>

#include <functional>
#include <optional>
#include <vector>

#include "core/stats/binomial.h"
#include "ui/charts/chart_theme.h"

/// What a chart shows, as values: made from a study's curves, drawn by a CurveChart.

namespace trapwright::charts {

enum class Scale { linear, logarithmic };

enum class Marker { none, dot, circle, square, triangle, diamond };

/// Curves differ by dash and marker too, so that they can be told apart in print.
struct CurveStyle {
    SeriesColour colour = SeriesColour::first;
    Qt::PenStyle line = Qt::SolidLine;
    Marker marker = Marker::none;
    bool second = false;  // of the second of two studies: lighter, hollow markers

    friend bool operator==(const CurveStyle&, const CurveStyle&) = default;
};

struct Curve {
    QString name;      // where values are read off
    QString column;    // in CSV, with the unit
    QStringList keys;  // shown while all legend entries with these keys are on
    CurveStyle style;
    std::vector<QPointF> points;          // x rising; on a logarithmic scale only those with y > 0 are drawn
    std::optional<double> level{};        // instead of points: a horizontal line
    std::vector<stats::Interval> band{};  // slot i about points[i], drawn as an area; empty: none
    QStringList bandColumns{};            // in CSV, of its low and its high end
    bool isScattered = false;             // points by themselves, x in any order
    /// Of points[i], where the points of a scattered curve can be picked. Of many points only the one that is
    /// pointed at is asked for.
    std::function<QString(std::size_t)> pointName{};
};

/// A place on the x axis that means something.
struct XMark {
    double x = 0.0;
    CurveStyle style;
};

struct PlotSheet {
    QString key;            // shown while the legend entry with this key, if there is one, is on
    QString xTitle;         // HTML
    QString yTitle;         // HTML, with the unit
    QString yShortTitle{};  // of a plot that is too low for that; empty: the same
    Scale yScale = Scale::linear;
    int decimals = 3;                 // of values that are read off
    double leastHeight = 0.0;         // of the fitted y range; decades on a logarithmic scale
    std::vector<double> yIncluded{};  // always within the fitted y range
    double leastWidth = 10.0;         // of the fitted x range
    bool isWhole = true;   // x is whole numbers; else its values are read off where a curve has points
    double xStep = 0.0;    // between points that farther apart miss data between them; 0: they never do
    bool byPoint = false;  // points of scattered curves are read off and picked one by one, none by its x
    std::optional<XMark> mark{};
    std::vector<Curve> curves;
};

struct LegendEntry {
    QString key;
    QString text;
    QString help;                        // one sentence
    std::optional<CurveStyle> sample{};  // none: chooses a plot
    bool on = true;                      // until the user switches it
    bool fixed = false;                  // tells what something is and cannot be switched
};

/// Plots side by side that share their x axis.
struct ChartSheet {
    QString xColumn;  // in CSV
    std::vector<LegendEntry> legend;
    std::vector<PlotSheet> plots;
};

/// The numbers of all curves, those not shown as well: a line for each x that any has, an empty field where a
/// curve has no point there. RFC 4180 with \n; numbers in full with a point as decimal sign.
QString toCsv(const ChartSheet& sheet);

}  // namespace trapwright::charts
