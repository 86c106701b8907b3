#pragma once

#include <QPainter>
#include <QPen>
#include <QPolygonF>
#include <vector>

#include "ui/charts/chart_theme.h"
#include "ui/charts/sheet.h"

/// How curves are drawn, in the plot, in the legend and where values are read off.
namespace trapwright::charts {

/// The pen of a curve. The second study's curves have other dashes.
QPen curvePen(const CurveStyle& style, const ChartTheme& theme);

void paintMarker(QPainter& painter, const QPointF& centre, const CurveStyle& style, const ChartTheme& theme);

/// A short piece of the curve with its marker; a filled square for a style without a line.
void paintSample(QPainter& painter, const QRectF& rect, const CurveStyle& style, const ChartTheme& theme);

/// The parts of a polyline that are inside the rectangle. (A painter's own clipping does not reach SVG.)
std::vector<QPolygonF> clipPolyline(const QPolygonF& line, const QRectF& rect);

}  // namespace trapwright::charts
