#include "ui/charts/read_off.h"

#include <algorithm>

#include "ui/charts/curve_style.h"

namespace trapwright::charts {

namespace {

constexpr double kPadding = 6.0;
constexpr double kSampleWidth = 20.0;
constexpr double kGap = 8.0;
constexpr double kDistance = 10.0;   // of the box from the line
constexpr double kMostShare = 0.33;  // of the plot's width, for names and values

}  // namespace

void paintReadOff(QPainter& painter, const QRectF& plotArea, double x, const QString& heading,
                  const std::vector<ReadValue>& values, const ChartTheme& theme) {
    painter.save();
    painter.setPen(QPen(theme.axis, 1.0));
    painter.drawLine(QPointF(x, plotArea.top()), QPointF(x, plotArea.bottom()));
    for (const ReadValue& value : values) {
        if (!plotArea.contains(value.place)) continue;
        painter.setPen(QPen(theme.series(value.style.colour, value.style.second), 2.0));
        painter.setBrush(theme.background);
        painter.drawEllipse(value.place, 4.5, 4.5);
    }

    const QFontMetricsF metrics(painter.font());
    double nameWidth = 0.0;
    double valueWidth = 0.0;
    for (const ReadValue& value : values) {
        nameWidth = std::max(nameWidth, metrics.horizontalAdvance(value.name) + kGap);
        valueWidth = std::max(valueWidth, metrics.horizontalAdvance(value.value));
    }
    // In a narrow plot the samples must do: the legend says what they are.
    const bool named = nameWidth + valueWidth < kMostShare * plotArea.width();
    if (!named) nameWidth = 0.0;
    const double lineWidth =
        std::max(metrics.horizontalAdvance(heading), kSampleWidth + kGap + nameWidth + valueWidth);
    const double lineHeight = metrics.height() + 2.0;
    QRectF box(0, 0, lineWidth + 2 * kPadding,
               lineHeight * (1.0 + static_cast<double>(values.size())) + 2 * kPadding);
    // On the side with more room, and inside the plot as far as it fits.
    const bool right = x < plotArea.center().x();
    box.moveLeft(right ? x + kDistance : x - kDistance - box.width());
    box.moveLeft(
        std::clamp(box.left(), plotArea.left(), std::max(plotArea.left(), plotArea.right() - box.width())));
    box.moveTop(plotArea.top() + kPadding);

    QColor back = theme.box;
    back.setAlphaF(0.92F);
    painter.setPen(QPen(theme.grid, 1.0));
    painter.setBrush(back);
    painter.drawRoundedRect(box, 3.0, 3.0);
    QRectF line(box.left() + kPadding, box.top() + kPadding, lineWidth, lineHeight);
    painter.setPen(theme.text);
    painter.drawText(line, Qt::AlignVCenter | Qt::AlignLeft, heading);
    for (const ReadValue& value : values) {
        line.translate(0, lineHeight);
        const QRectF sample(line.left(), line.top() + 2.0, kSampleWidth, line.height() - 4.0);
        paintSample(painter, sample, value.style, theme);
        painter.setPen(theme.text);
        if (named) {
            painter.drawText(line.adjusted(kSampleWidth + kGap, 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft,
                             value.name);
        }
        painter.drawText(line, Qt::AlignVCenter | Qt::AlignRight, value.value);
    }
    painter.restore();
}

}  // namespace trapwright::charts
