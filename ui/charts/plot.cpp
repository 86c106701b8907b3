#include "ui/charts/plot.h"

#include <QApplication>
#include <QCategoryAxis>
#include <QChart>
#include <QMouseEvent>
#include <QTextDocument>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "ui/charts/axes.h"
#include "ui/charts/chart_view.h"

namespace trapwright::charts {

namespace {

constexpr double kPadding = 0.04;      // of a fitted range, at both ends
constexpr double kWheelFactor = 1.25;  // of one notch
constexpr double kNotch = 120.0;       // QWheelEvent's unit
constexpr double kLeastWidth = 4.0;    // that can be zoomed to, of whole numbers
constexpr double kLeastShare = 1e-4;   // of the fitted height that can be zoomed to
constexpr double kTickSpace = 48.0;    // between labels along x, at least
constexpr int kMostUp = 8;             // labels along y
constexpr double kTitleShare = 0.95;   // of the plot's height that a title may take

void setTicks(QCategoryAxis* axis, const std::vector<Tick>& ticks, const Range& range) {
    QStringList labels;
    for (const Tick& tick : ticks)
        labels.append(tick.label);
    const bool same = labels == axis->categoriesLabels();
    axis->setRange(range.low, range.high);
    if (same) return;
    for (const QString& old : axis->categoriesLabels())
        axis->remove(old);
    // Where nothing is drawn: the axis has a grid line there as well.
    axis->setStartValue(range.low - range.size());
    for (const Tick& tick : ticks)
        axis->append(tick.label, tick.position);
}

bool isPickable(const Curve& curve) {
    return curve.isScattered && curve.pointName != nullptr && !curve.points.empty();
}

}  // namespace

Plot::Plot(QWidget* parent)
    : QChartView(parent),
      xAxis_(addLabelledAxis(*chart(), Qt::AlignBottom)),
      yAxis_(addLabelledAxis(*chart(), Qt::AlignLeft)) {
    setUpView(*this, 8);
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    viewport()->setMouseTracking(true);
    setMinimumSize(120, 90);
}

void Plot::setSheet(const PlotSheet& sheet) {
    sheet_ = sheet;
    xAxis_->setTitleText(sheet.xTitle);
    setAccessibleName(QString(sheet.yTitle).remove("<sub>").remove("</sub>"));
    curves_.resize(sheet_.curves.size());
    point_.reset();
    updateCurves();
    updateLimits();
    updateTitle();
    updateView();
}

void Plot::setTheme(const ChartTheme& theme) {
    theme_ = theme;
    applyTheme(*this, theme, {xAxis_, yAxis_});
}

void Plot::setShown(std::vector<bool> shown) {
    for (std::size_t i = 0; i < curves_.size(); ++i)
        curves_[i].shown = i >= shown.size() || shown[i];
    updateLimits();
    updateView();
}

void Plot::fit() {
    fitted_ = true;
    updateLimits();
    updateView();
    emit xRangeChanged();
}

void Plot::zoom(double factor) {
    x_ = zoomRange(x_, cursor_.value_or((x_.low + x_.high) / 2.0), factor, xLimits_, leastWidth());
    fitted_ = x_ == xLimits_ && y_ == yLimits_;
    updateView();
    emit xRangeChanged();
}

void Plot::setXRange(const Range& range) {
    x_ = shiftRange(range, 0.0, xLimits_);
    fitted_ = x_ == xLimits_ && y_ == yLimits_;
    updateView();
}

void Plot::setCursor(std::optional<double> x) {
    if (cursor_ == x) return;
    cursor_ = x;
    setAccessibleDescription(readOff().join(u'\n'));
    viewport()->update();
}

void Plot::stepPoint(int step) {
    const std::vector<Curve>& curves = sheet_.curves;
    std::optional<std::size_t> top;
    for (std::size_t i = 0; i < curves.size(); ++i)
        if (isPickable(curves[i])) top = i;
    if (!top) return;
    const int last = static_cast<int>(curves[*top].points.size()) - 1;
    const int from = point_ && point_->curve == *top ? static_cast<int>(point_->index) : -1;
    const int to = from < 0 ? 0 : std::clamp(from + step, 0, last);
    movePointTo(PlotPoint{*top, static_cast<std::size_t>(to)});
}

void Plot::pickPoint() {
    if (point_) emit pointPicked(point_->curve, point_->index);
}

void Plot::movePointTo(std::optional<PlotPoint> point) {
    if (point_ == point) return;
    point_ = point;
    setAccessibleDescription(readOff().join(u'\n'));
    viewport()->update();
}

/// The nearest one that is in reach and shown; one under the cursor of a curve on top goes before any of
/// those below it.
std::optional<PlotPoint> Plot::findPoint(const QPointF& position) const {
    constexpr double kReach = 16.0;  // pixels
    constexpr double kUnder = 5.0;
    std::optional<PlotPoint> nearest;
    double least = kReach;
    for (std::size_t i = curves_.size(); i-- > 0;) {
        if (!curves_[i].shown || !isPickable(sheet_.curves[i])) continue;
        for (std::size_t at = 0; at < sheet_.curves[i].points.size(); ++at) {
            const QPointF away = toWidget(sheet_.curves[i].points[at]) - position;
            const double distance = std::hypot(away.x(), away.y());
            if (distance >= least) continue;
            least = distance;
            nearest = PlotPoint{i, at};
        }
        if (nearest && nearest->curve == i && least < kUnder) break;
    }
    return nearest;
}

void Plot::setPicturing(bool picturing) {
    picturing_ = picturing;
}

QPointF Plot::toWidget(const QPointF& value) const {
    const QRectF area = plotArea();
    return {area.left() + (value.x() - x_.low) / x_.size() * area.width(),
            area.bottom() - (toAxis(value.y()) - y_.low) / y_.size() * area.height()};
}

double Plot::leastWidth() const {
    return sheet_.isWhole ? kLeastWidth : kLeastShare * xLimits_.size();
}

QRectF Plot::plotArea() const {
    return chart()->plotArea();
}

double Plot::toAxis(double value) const {
    return sheet_.yScale == Scale::logarithmic ? std::log10(value) : value;
}

/// y in the axis's own coordinate.
QPointF Plot::fromWidget(const QPointF& position) const {
    const QRectF area = plotArea();
    return {x_.low + (position.x() - area.left()) / area.width() * x_.size(),
            y_.low + (area.bottom() - position.y()) / area.height() * y_.size()};
}

void Plot::updateCurves() {
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        const Curve& curve = sheet_.curves[i];
        DrawnCurve& drawn = curves_[i];
        for (QPolygonF* line : {&drawn.points, &drawn.low, &drawn.high})
            line->clear();
        for (std::size_t at = 0; at < curve.points.size(); ++at) {
            const QPointF& point = curve.points[at];
            const double y = toAxis(point.y());
            if (!std::isfinite(y)) continue;
            drawn.points.append({point.x(), y});
            if (curve.band.empty()) continue;
            drawn.low.append({point.x(), toAxis(curve.band[at].low)});
            drawn.high.append({point.x(), toAxis(curve.band[at].high)});
        }
        // A level goes from edge to edge of the view.
        if (curve.level) drawn.points = {{x_.low, toAxis(*curve.level)}, {x_.high, toAxis(*curve.level)}};
    }
}

void Plot::updateLimits() {
    Extent x;
    Extent y;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        // The x range is that of all curves, so that switching one off does not move the others.
        for (const QPointF& point : sheet_.curves[i].points)
            x.add(point.x());
        if (!curves_[i].shown) continue;
        for (const QPolygonF* line : {&curves_[i].points, &curves_[i].low, &curves_[i].high})
            for (const QPointF& point : *line)
                y.add(point.y());
    }
    for (const double value : sheet_.yIncluded)
        y.add(toAxis(value));
    const Range width = x.range(0.0, 0.0).value_or(Range{0.0, 0.0});
    const double high = std::max(width.high, width.low + sheet_.leastWidth);
    const double padding = kPadding / 2.0 * (high - width.low);
    xLimits_ = {width.low - padding, high + padding};
    yLimits_ = y.range(sheet_.leastHeight, kPadding).value_or(Range{0.0, 1.0});
    if (!(yLimits_.size() > 0.0)) yLimits_ = {yLimits_.low - 0.5, yLimits_.low + 0.5};
    if (fitted_) {
        x_ = xLimits_;
        y_ = yLimits_;
    }
}

void Plot::updateView() {
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        if (!sheet_.curves[i].level) continue;
        curves_[i].points.front().setX(x_.low);
        curves_[i].points.back().setX(x_.high);
    }
    updateTicks();
    viewport()->update();
}

void Plot::updateTicks() {
    const QRectF area = plotArea();
    const QFontMetricsF metrics(font());
    const auto mostAlong = static_cast<int>(area.width() / kTickSpace);
    const auto mostUp = std::min(kMostUp, static_cast<int>(area.height() / (1.8 * metrics.height())));
    setTicks(xAxis_, linearTicks(x_, std::max(2, mostAlong), sheet_.isWhole ? 1.0 : 0.0), x_);
    const int most = std::max(2, mostUp);
    setTicks(yAxis_, sheet_.yScale == Scale::logarithmic ? logarithmicTicks(y_, most) : linearTicks(y_, most),
             y_);
}

/// An axis cuts a title that is longer than itself.
void Plot::updateTitle() {
    QTextDocument title;
    title.setDefaultFont(font());
    title.setDocumentMargin(0.0);
    title.setHtml(sheet_.yTitle);
    const bool fits = sheet_.yShortTitle.isEmpty() || title.idealWidth() < kTitleShare * plotArea().height();
    yAxis_->setTitleText(fits ? sheet_.yTitle : sheet_.yShortTitle);
}

void Plot::resizeEvent(QResizeEvent* event) {
    QChartView::resizeEvent(event);
    updateTitle();
    updateTicks();
}

void Plot::wheelEvent(QWheelEvent* event) {
    const QRectF area = plotArea();
    const QPointF position = event->position();
    const double factor = std::pow(kWheelFactor, -event->angleDelta().y() / kNotch);
    const QPointF anchor = fromWidget(position);
    const bool belowAxis = position.y() > area.bottom();
    const bool besideAxis = position.x() < area.left();
    if (!besideAxis) x_ = zoomRange(x_, anchor.x(), factor, xLimits_, leastWidth());
    if (!belowAxis) y_ = zoomRange(y_, anchor.y(), factor, yLimits_, kLeastShare * yLimits_.size());
    fitted_ = x_ == xLimits_ && y_ == yLimits_;
    updateView();
    emit xRangeChanged();
    event->accept();
}

void Plot::mousePressEvent(QMouseEvent* event) {
    setFocus(Qt::MouseFocusReason);
    if (event->button() == Qt::LeftButton && plotArea().contains(event->position())) {
        pressed_ = dragged_ = event->position();
        dragging_ = false;
    }
    event->accept();
}

void Plot::mouseMoveEvent(QMouseEvent* event) {
    if (pressed_) {
        const QPointF moved = event->position() - *pressed_;
        if (moved.manhattanLength() > QApplication::startDragDistance()) dragging_ = true;
        if (dragging_) {
            viewport()->setCursor(Qt::ClosedHandCursor);
            const QPointF by = fromWidget(dragged_) - fromWidget(event->position());
            dragged_ = event->position();
            x_ = shiftRange(x_, by.x(), xLimits_);
            y_ = shiftRange(y_, by.y(), yLimits_);
            updateView();
            emit xRangeChanged();
            return;
        }
    }
    moveCursorTo(event->position());
}

void Plot::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    if (pressed_ && !dragging_) {
        // Whatever came between, such as a leave.
        moveCursorTo(event->position());
        if (cursor_) emit picked(*cursor_);
        pickPoint();
    }
    pressed_.reset();
    dragging_ = false;
    viewport()->unsetCursor();
}

void Plot::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton) emit fitWanted();
}

void Plot::leaveEvent(QEvent* event) {
    QChartView::leaveEvent(event);
    movePointTo(std::nullopt);
    emit cursorMoved(std::nullopt);
}

void Plot::moveCursorTo(const QPointF& position) {
    if (sheet_.byPoint)
        return movePointTo(plotArea().contains(position) ? findPoint(position) : std::nullopt);
    Extent extent;
    for (const Curve& curve : sheet_.curves) {
        for (const QPointF& point : curve.points)
            extent.add(point.x());
    }
    const std::optional<Range> known = extent.range(0.0, 0.0);
    if (!known || !plotArea().contains(position)) {
        emit cursorMoved(std::nullopt);
        return;
    }
    const double x = fromWidget(position).x();
    if (sheet_.isWhole) {
        emit cursorMoved(std::clamp(std::round(x), known->low, known->high));
        return;
    }
    std::optional<double> nearest;
    for (const Curve& curve : sheet_.curves) {
        for (const QPointF& point : curve.points)
            if (!nearest || std::abs(point.x() - x) < std::abs(*nearest - x)) nearest = point.x();
    }
    emit cursorMoved(nearest);
}

}  // namespace trapwright::charts
