#include <algorithm>
#include <cmath>

#include "ui/charts/curve_style.h"
#include "ui/charts/plot.h"
#include "ui/charts/read_off.h"

/// What a plot draws over its chart: markers, and the values under the cursor.
namespace trapwright::charts {

namespace {

constexpr double kMarkerSpace = 70.0;  // between the markers of a curve
constexpr double kSlack = 0.5;         // pixels that a point on the plot's edge may be outside

/// The least of 1, 2, 5, 10 ... generations that are so many pixels apart.
int strideFor(double pixelsPerUnit) {
    int power = 1;
    while (power < 1'000'000) {
        for (const int factor : {1, 2, 5}) {
            if (factor * power * pixelsPerUnit >= kMarkerSpace) return factor * power;
        }
        power *= 10;
    }
    return power;
}

/// The value of a curve at x; nothing where it has no point.
std::optional<double> valueAt(const Curve& curve, double x) {
    if (curve.level) return curve.level;
    const auto found =
        std::lower_bound(curve.points.begin(), curve.points.end(), x,
                         [](const QPointF& point, double wanted) { return point.x() < wanted; });
    if (found == curve.points.end() || found->x() != x) return std::nullopt;
    return found->y();
}

QString valueText(std::optional<double> value, int decimals) {
    if (!value) return QStringLiteral("–");
    const bool nothing = std::abs(*value) < 0.5 * std::pow(10.0, -decimals);
    return QString::number(nothing ? 0.0 : *value, 'f', decimals);
}

}  // namespace

QStringList Plot::readOff() const {
    if (!cursor_) return {};
    QStringList lines{QStringLiteral("%1 %2").arg(sheet_.xTitle).arg(*cursor_)};
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        if (!curves_[i].shown) continue;
        const Curve& curve = sheet_.curves[i];
        lines.append(
            QStringLiteral("%1: %2").arg(curve.name, valueText(valueAt(curve, *cursor_), sheet_.decimals)));
    }
    return lines;
}

void Plot::drawForeground(QPainter* painter, const QRectF&) {
    painter->save();
    painter->setFont(font());
    paintMark(*painter);
    if (picturing_) paintCurves(*painter);
    for (std::size_t i = 0; i < curves_.size(); ++i)
        if (curves_[i].shown) paintMarkers(*painter, i);
    const bool reading = cursor_ && !picturing_ && !dragging_ && x_.contains(*cursor_);
    if (reading) {
        std::vector<ReadValue> values;
        for (std::size_t i = 0; i < curves_.size(); ++i) {
            if (!curves_[i].shown) continue;
            const Curve& curve = sheet_.curves[i];
            const std::optional<double> value = valueAt(curve, *cursor_);
            const bool drawn = value && std::isfinite(toAxis(*value));
            // A level has no point to be met.
            const QPointF place = drawn && !curve.level ? toWidget({*cursor_, *value}) : QPointF(-1e9, -1e9);
            values.push_back({curve.style, curve.name, valueText(value, sheet_.decimals), place});
        }
        paintReadOff(*painter, plotArea(), toWidget({*cursor_, 1.0}).x(),
                     QStringLiteral("%1 %2").arg(sheet_.xTitle).arg(*cursor_), values, theme_);
    }
    painter->restore();
}

void Plot::paintMark(QPainter& painter) const {
    if (!sheet_.mark || !x_.contains(sheet_.mark->x)) return;
    const QRectF area = plotArea();
    const double x = area.left() + (sheet_.mark->x - x_.low) / x_.size() * area.width();
    painter.setPen(curvePen(sheet_.mark->style, theme_));
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
}

void Plot::paintMarkers(QPainter& painter, std::size_t curve) const {
    const CurveStyle& style = sheet_.curves[curve].style;
    const QPolygonF& points = curves_[curve].points;
    if (style.marker == Marker::none || points.isEmpty()) return;
    const QRectF area = plotArea();
    const QRectF inside = area.adjusted(-kSlack, -kSlack, kSlack, kSlack);
    const int stride = strideFor(area.width() / x_.size());
    // Each curve has its markers at other places, so that they do not hide each other.
    const int offset = static_cast<int>(curve) * stride / static_cast<int>(curves_.size());
    const auto place = [&](const QPointF& point) {
        return QPointF(area.left() + (point.x() - x_.low) / x_.size() * area.width(),
                       area.bottom() - (point.y() - y_.low) / y_.size() * area.height());
    };
    const QPointF last = place(points.back());
    for (const QPointF& point : points) {
        if (static_cast<int>(point.x()) % stride != offset) continue;
        const QPointF centre = place(point);
        if (inside.contains(centre) && last.x() - centre.x() > kMarkerSpace / 3.0)
            paintMarker(painter, centre, style, theme_);
    }
    if (inside.contains(last)) paintMarker(painter, last, style, theme_);
}

void Plot::paintCurves(QPainter& painter) const {
    const QRectF area = plotArea();
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        if (!curves_[i].shown) continue;
        QPolygonF line;
        for (const QPointF& point : curves_[i].points) {
            line.append({area.left() + (point.x() - x_.low) / x_.size() * area.width(),
                         area.bottom() - (point.y() - y_.low) / y_.size() * area.height()});
        }
        painter.setPen(curvePen(sheet_.curves[i].style, theme_));
        painter.setBrush(Qt::NoBrush);
        for (const QPolygonF& piece : clipPolyline(line, area))
            painter.drawPolyline(piece);
    }
}

}  // namespace trapwright::charts
