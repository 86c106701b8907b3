#include "ui/charts/curve_style.h"

#include <algorithm>

namespace trapwright::charts {

namespace {

constexpr double kLineWidth = 1.8;
constexpr double kMarkerSize = 7.0;
constexpr double kDotRadius = 2.2;
constexpr float kDotOpacity = 0.45F;  // where many are, it is darker

/// In multiples of the line's width; empty: solid.
QList<qreal> dashesOf(const CurveStyle& style) {
    switch (style.line) {
        case Qt::DashLine:
            return style.second ? QList<qreal>{3, 2, 1, 2, 1, 2} : QList<qreal>{4, 2.2};
        case Qt::DotLine:
            return style.second ? QList<qreal>{1, 3.4} : QList<qreal>{1.2, 2};
        case Qt::DashDotLine:
            return style.second ? QList<qreal>{1.5, 2.5} : QList<qreal>{5, 2, 1.2, 2};
        default:
            return style.second ? QList<qreal>{9, 2.5} : QList<qreal>{};
    }
}

/// The piece of a segment inside the rectangle, as shares of its length (Liang and Barsky 1984).
bool clipSegment(const QPointF& from, const QPointF& to, const QRectF& rect, double& begin, double& end) {
    begin = 0.0;
    end = 1.0;
    const QPointF along = to - from;
    const double steps[4] = {-along.x(), along.x(), -along.y(), along.y()};
    const double rooms[4] = {from.x() - rect.left(), rect.right() - from.x(), from.y() - rect.top(),
                             rect.bottom() - from.y()};
    for (int side = 0; side < 4; ++side) {
        if (steps[side] == 0.0) {
            if (rooms[side] < 0.0) return false;
            continue;
        }
        const double share = rooms[side] / steps[side];
        if (steps[side] < 0.0) {
            begin = std::max(begin, share);
        } else {
            end = std::min(end, share);
        }
    }
    return begin <= end;
}

}  // namespace

QPen curvePen(const CurveStyle& style, const ChartTheme& theme) {
    QPen pen(theme.series(style.colour, style.second), kLineWidth);
    pen.setCapStyle(Qt::FlatCap);
    pen.setJoinStyle(Qt::RoundJoin);
    if (const QList<qreal> dashes = dashesOf(style); !dashes.isEmpty()) pen.setDashPattern(dashes);
    return pen;
}

void paintMarker(QPainter& painter, const QPointF& centre, const CurveStyle& style, const ChartTheme& theme) {
    if (style.marker == Marker::none) return;
    QColor colour = theme.series(style.colour, style.second);
    if (style.marker == Marker::dot) colour.setAlphaF(kDotOpacity);
    painter.save();
    painter.setPen(QPen(style.second ? colour : theme.background, style.second ? 1.4 : 0.8));
    painter.setBrush(style.second ? theme.background : colour);
    const double r = kMarkerSize / 2.0;
    switch (style.marker) {
        case Marker::none:
            break;
        case Marker::dot:
            painter.setPen(Qt::NoPen);
            painter.drawEllipse(centre, kDotRadius, kDotRadius);
            break;
        case Marker::circle:
            painter.drawEllipse(centre, r, r);
            break;
        case Marker::square:
            painter.drawRect(QRectF(centre - QPointF(0.9 * r, 0.9 * r), QSizeF(1.8 * r, 1.8 * r)));
            break;
        case Marker::triangle:
            painter.drawPolygon(QPolygonF{centre + QPointF(0, -1.2 * r), centre + QPointF(1.1 * r, 0.8 * r),
                                          centre + QPointF(-1.1 * r, 0.8 * r)});
            break;
        case Marker::diamond:
            painter.drawPolygon(QPolygonF{centre + QPointF(0, -1.25 * r), centre + QPointF(1.25 * r, 0),
                                          centre + QPointF(0, 1.25 * r), centre + QPointF(-1.25 * r, 0)});
            break;
    }
    painter.restore();
}

void paintSample(QPainter& painter, const QRectF& rect, const CurveStyle& style, const ChartTheme& theme) {
    painter.save();
    if (style.line == Qt::NoPen && style.marker != Marker::none) {
        paintMarker(painter, rect.center(), style, theme);
    } else if (style.line == Qt::NoPen) {
        const double side = std::min({rect.width(), rect.height(), 11.0});
        QRectF square(0, 0, side, side);
        square.moveCenter(rect.center());
        painter.fillRect(square, theme.series(style.colour, style.second));
    } else {
        painter.setPen(curvePen(style, theme));
        painter.drawLine(QPointF(rect.left(), rect.center().y()), QPointF(rect.right(), rect.center().y()));
        paintMarker(painter, rect.center(), style, theme);
    }
    painter.restore();
}

std::vector<QPolygonF> clipPolyline(const QPolygonF& line, const QRectF& rect) {
    std::vector<QPolygonF> pieces;
    bool open = false;
    for (qsizetype i = 1; i < line.size(); ++i) {
        const QPointF from = line[i - 1];
        const QPointF to = line[i];
        double begin = 0.0;
        double end = 0.0;
        if (!clipSegment(from, to, rect, begin, end)) {
            open = false;
            continue;
        }
        if (!open || begin > 0.0) pieces.push_back({from + begin * (to - from)});
        pieces.back().push_back(from + end * (to - from));
        open = end == 1.0;
    }
    return pieces;
}

}  // namespace trapwright::charts
