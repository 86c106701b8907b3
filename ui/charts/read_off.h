#pragma once

#include <QPainter>
#include <QString>
#include <vector>

#include "ui/charts/chart_theme.h"
#include "ui/charts/sheet.h"

namespace trapwright::charts {

/// A value under the cursor.
struct ReadValue {
    CurveStyle style;
    QString name;
    QString value;
    QPointF place;  // of the point in the plot
};

/// Draws the cursor's line at x, the points that it meets, and a box with their values beside it.
void paintReadOff(QPainter& painter, const QRectF& plotArea, double x, const QString& heading,
                  const std::vector<ReadValue>& values, const ChartTheme& theme);

}  // namespace trapwright::charts
