#include "ui/scene/force_legend.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <QGuiApplication>
#include <QLocale>

#include <algorithm>
#include <array>
#include <cmath>

namespace trapwright::scene {

namespace {

constexpr double kLongest = 6.0;  // in bounding radii

constexpr double kMargin = 16.0;
constexpr double kHead = 5.0;
constexpr std::array kWeights{1.0, 10.0, 30.0};  // forces that are drawn, about

struct Sample {
    QString text;
    double length = 0.0;  // logical pixels
};

/// 1, 2 or 5 times a power of ten, at most `force`. [N]
double roundForce(double force) {
    const double power = std::pow(10.0, std::floor(std::log10(force)));
    for (const double factor : {5.0, 2.0})
        if (factor * power <= force) return factor * power;
    return power;
}

QString forceText(double force) {
    const bool milli = force < 0.1;
    return QLocale().toString(milli ? 1e3 * force : force, 'g', 2) +
           (milli ? QStringLiteral(" mN") : QStringLiteral(" N"));
}

void paintArrow(QPainter& painter, const QPointF& from, double length) {
    const QPointF tip = from + QPointF(length, 0.0);
    painter.drawLine(from, tip);
    painter.drawPolyline(
        QPolygonF({tip + QPointF(-kHead, -0.6 * kHead), tip, tip + QPointF(-kHead, 0.6 * kHead)}));
}

}  // namespace

double arrowLength(const part::Part& part, double force) {
    const double weight = part.massProperties.mass * base::kStandardGravity;
    if (force <= 0.0 || weight <= 0.0) return 0.0;
    return part.boundingRadius * std::min(std::sqrt(force / weight), kLongest);
}

OverlayItem makeForceLegend(const SceneContents& contents, const Camera& camera, const QSizeF& screen) {
    const part::Part& part = *contents.parts.front().part;
    const double weight = part.massProperties.mass * base::kStandardGravity;
    // Where the part is; the camera's focus may be elsewhere.
    const double scale = camera.metresPerPixel(screen);
    const QFontMetricsF metrics(QGuiApplication::font());
    const QString title = QCoreApplication::translate("scene", "Contact forces");
    std::vector<Sample> samples;
    double longest = 0.0;
    double widest = metrics.horizontalAdvance(title);
    for (const double factor : kWeights) {
        const double force = roundForce(factor * weight);
        samples.push_back({forceText(force), arrowLength(part, force) / scale});
        longest = std::max(longest, samples.back().length);
    }
    for (const Sample& sample : samples)
        widest = std::max(widest, longest + 10.0 + metrics.horizontalAdvance(sample.text));
    const double line = metrics.height() + 2.0;
    const QRectF area(kMargin - 6.0, kMargin - 6.0, std::ceil(widest) + 16.0,
                      std::ceil(line * static_cast<double>(samples.size() + 1)) + 8.0);
    const SceneTheme theme = contents.theme;
    return {area, [=](QPainter& painter) {
                QColor field = theme.backgroundTop;
                field.setAlphaF(0.82F);
                painter.setPen(Qt::NoPen);
                painter.setBrush(field);
                painter.drawRoundedRect(area, 4.0, 4.0);
                painter.setPen(theme.text);
                double y = area.top() + 4.0;
                painter.drawText(QPointF(area.left() + 8.0, y + metrics.ascent()), title);
                for (const Sample& sample : samples) {
                    y += line;
                    painter.setPen(QPen(theme.contact, 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
                    paintArrow(painter, {area.left() + 8.0, y + 0.5 * metrics.height()}, sample.length);
                    painter.setPen(theme.text);
                    painter.drawText(QPointF(area.left() + 18.0 + longest, y + metrics.ascent()),
                                     sample.text);
                }
            }};
}

}  // namespace trapwright::scene
