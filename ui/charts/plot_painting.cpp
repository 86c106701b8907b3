#include <algorithm>
#include <cmath>

#include "ui/charts/curve_style.h"
#include "ui/charts/plot.h"
#include "ui/charts/read_off.h"

/// What a plot draws over its chart: curves with their bands and markers, and the values under the cursor.
namespace trapwright::charts {

namespace {

constexpr double kMarkerSpace = 11.0;  // between neighbours of a curve where each has a marker
constexpr double kSlack = 0.5;         // pixels that a point on the plot's edge may be outside
constexpr float kBandOpacity = 0.16F;

/// The value of a curve at x; nothing where it has no point.
std::optional<double> valueAt(const Curve& curve, double x) {
    if (curve.level) return curve.level;
    const auto found =
        std::lower_bound(curve.points.begin(), curve.points.end(), x,
                         [](const QPointF& point, double wanted) { return point.x() < wanted; });
    if (found == curve.points.end() || found->x() != x) return std::nullopt;
    return found->y();
}

QString numberText(double value, int decimals) {
    const bool nothing = std::abs(value) < 0.5 * std::pow(10.0, -decimals);
    return QString::number(nothing ? 0.0 : value, 'f', decimals);
}

/// "0.400", with a band "85.0 (62.1 … 96.8)".
QString valueText(const Curve& curve, double x, int decimals) {
    const std::optional<double> value = valueAt(curve, x);
    if (!value) return QStringLiteral("–");
    QString text = numberText(*value, decimals);
    if (curve.band.empty()) return text;
    const auto found = std::find_if(curve.points.begin(), curve.points.end(),
                                    [x](const QPointF& point) { return point.x() == x; });
    const stats::Interval& band = curve.band[static_cast<std::size_t>(found - curve.points.begin())];
    return QStringLiteral("%1 (%2 … %3)")
        .arg(text, numberText(band.low, decimals), numberText(band.high, decimals));
}

}  // namespace

QStringList Plot::readOff() const {
    if (point_) {
        const Curve& curve = sheet_.curves[point_->curve];
        const QPointF& value = curve.points[point_->index];
        return {curve.pointName(point_->index),
                QStringLiteral("%1: %2").arg(sheet_.xTitle, numberText(value.x(), sheet_.decimals)),
                QStringLiteral("%1: %2").arg(sheet_.yTitle, numberText(value.y(), sheet_.decimals))};
    }
    if (!cursor_) return {};
    QStringList lines{QStringLiteral("%1 %2").arg(sheet_.xTitle).arg(*cursor_)};
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        if (!curves_[i].shown) continue;
        const Curve& curve = sheet_.curves[i];
        lines.append(QStringLiteral("%1: %2").arg(curve.name, valueText(curve, *cursor_, sheet_.decimals)));
    }
    return lines;
}

void Plot::drawForeground(QPainter* painter, const QRectF&) {
    painter->save();
    painter->setFont(font());
    paintBands(*painter);
    paintMark(*painter);
    paintCurves(*painter);
    for (std::size_t i = 0; i < curves_.size(); ++i)
        if (curves_[i].shown) paintMarkers(*painter, i);
    if (point_ && !picturing_ && !dragging_) paintPoint(*painter);
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
            values.push_back({curve.style, curve.name, valueText(curve, *cursor_, sheet_.decimals), place});
        }
        paintReadOff(*painter, plotArea(), toWidget({*cursor_, 1.0}).x(),
                     QStringLiteral("%1 %2").arg(sheet_.xTitle).arg(*cursor_), values, theme_);
    }
    painter->restore();
}

void Plot::paintPoint(QPainter& painter) const {
    const Curve& curve = sheet_.curves[point_->curve];
    const QPointF& value = curve.points[point_->index];
    const QPointF place = toWidget(value);
    if (!plotArea().contains(place)) return;
    const QPointF nowhere(-1e9, -1e9);
    const QStringList lines = readOff();
    paintReadOff(painter, plotArea(), place.x(), lines.front(),
                 {{curve.style, sheet_.xTitle, numberText(value.x(), sheet_.decimals), nowhere},
                  {curve.style, sheet_.yTitle, numberText(value.y(), sheet_.decimals), place}},
                 theme_);
}

void Plot::paintMark(QPainter& painter) const {
    if (!sheet_.mark || !x_.contains(sheet_.mark->x)) return;
    const QRectF area = plotArea();
    const double x = area.left() + (sheet_.mark->x - x_.low) / x_.size() * area.width();
    painter.setPen(curvePen(sheet_.mark->style, theme_));
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
}

QPointF Plot::placeOf(const QPointF& point) const {
    const QRectF area = plotArea();
    return {area.left() + (point.x() - x_.low) / x_.size() * area.width(),
            area.bottom() - (point.y() - y_.low) / y_.size() * area.height()};
}

std::vector<Plot::Piece> Plot::piecesOf(const QPolygonF& points) const {
    std::vector<Piece> pieces;
    for (qsizetype i = 0; i < points.size(); ++i) {
        const bool joined =
            i > 0 && (sheet_.xStep <= 0.0 || points[i].x() - points[i - 1].x() < 1.5 * sheet_.xStep);
        if (joined) {
            pieces.back().last = i;
        } else {
            pieces.push_back({i, i});
        }
    }
    return pieces;
}

/// Each point has a marker, or none has: markers here and there look as if data were missing between. A point
/// without neighbours has one always, as no line shows it.
void Plot::paintMarkers(QPainter& painter, std::size_t curve) const {
    if (sheet_.curves[curve].level) return;
    const CurveStyle& style = sheet_.curves[curve].style;
    const QPolygonF& points = curves_[curve].points;
    const QRectF area = plotArea();
    const QRectF inside = area.adjusted(-kSlack, -kSlack, kSlack, kSlack);
    if (sheet_.curves[curve].isScattered) {
        for (const QPointF& point : points)
            if (const QPointF centre = placeOf(point); inside.contains(centre))
                paintMarker(painter, centre, style, theme_);
        return;
    }
    for (const Piece& piece : piecesOf(points)) {
        const bool alone = piece.first == piece.last;
        if (!alone) {
            const double space = (placeOf(points[piece.last]).x() - placeOf(points[piece.first]).x()) /
                                 static_cast<double>(piece.last - piece.first);
            if (style.marker == Marker::none || space < kMarkerSpace) continue;
        }
        CurveStyle drawn = style;
        if (drawn.marker == Marker::none) drawn.marker = Marker::circle;
        for (qsizetype i = piece.first; i <= piece.last; ++i) {
            const QPointF centre = placeOf(points[i]);
            if (inside.contains(centre)) paintMarker(painter, centre, drawn, theme_);
        }
    }
}

/// Cut to the plot by our own arithmetic: QSvgGenerator of Qt 6.4 knows no clipping.
void Plot::paintBands(QPainter& painter) const {
    const QRectF area = plotArea();
    const bool isAlone =
        std::ranges::count_if(curves_, [](const DrawnCurve& curve) { return !curve.low.isEmpty(); }) == 1;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        if (!curves_[i].shown || curves_[i].low.isEmpty()) continue;
        // Lighter than the first one's, if there is that.
        const CurveStyle& style = sheet_.curves[i].style;
        QColor colour = theme_.series(style.colour, style.second && !isAlone);
        colour.setAlphaF(kBandOpacity);
        painter.setPen(Qt::NoPen);
        painter.setBrush(colour);
        for (const Piece& piece : piecesOf(curves_[i].low)) {
            QPolygonF outline;
            for (qsizetype at = piece.first; at <= piece.last; ++at)
                outline.append(placeOf(curves_[i].high[at]));
            for (qsizetype at = piece.last; at >= piece.first; --at)
                outline.append(placeOf(curves_[i].low[at]));
            if (piece.first == piece.last) {  // a bar, as wide as its marker
                outline = QRectF(outline[0] - QPointF(3.5, 0.0), outline[1] + QPointF(3.5, 0.0));
                outline.removeLast();
            }
            painter.drawPolygon(area.contains(outline.boundingRect()) ? outline : outline.intersected(area));
        }
    }
}

void Plot::paintCurves(QPainter& painter) const {
    const QRectF area = plotArea();
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        if (!curves_[i].shown || sheet_.curves[i].isScattered) continue;
        painter.setPen(curvePen(sheet_.curves[i].style, theme_));
        painter.setBrush(Qt::NoBrush);
        // A level is one line from edge to edge, whatever the step.
        const std::vector<Piece> pieces =
            sheet_.curves[i].level ? std::vector<Piece>{{0, 1}} : piecesOf(curves_[i].points);
        for (const Piece& piece : pieces) {
            QPolygonF line;
            for (qsizetype at = piece.first; at <= piece.last; ++at)
                line.append(placeOf(curves_[i].points[at]));
            for (const QPolygonF& cut : clipPolyline(line, area))
                painter.drawPolyline(cut);
        }
    }
}

}  // namespace trapwright::charts
