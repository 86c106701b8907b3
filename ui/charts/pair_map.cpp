#include "ui/charts/pair_map.h"

#include <QCategoryAxis>
#include <QChart>
#include <QHelpEvent>
#include <QToolTip>
#include <algorithm>

#include "ui/charts/chart_view.h"

namespace trapwright::charts {

namespace {

constexpr double kWhole = 100.0;      // [%]
constexpr double kLeastScale = 10.0;  // failures that a full colour stands for, at least [%]
constexpr double kDarkest = 0.85;     // of the colour
constexpr double kTickSpace = 44.0;   // between labels along x, at least

void setLabels(QCategoryAxis* axis, const QStringList& labels, int most) {
    for (const QString& old : axis->categoriesLabels())
        axis->remove(old);
    const auto count = static_cast<int>(labels.size());
    axis->setRange(-0.5, count - 0.5);
    axis->setStartValue(-1.0 - count);
    // Both ends, and those between as far as there is room.
    const int step = std::max(1, (count - 1 + most - 2) / std::max(1, most - 1));
    for (int i = 0; i < count; i += step)
        axis->append(labels[i], i);
}

}  // namespace

PairMap::PairMap(QWidget* parent)
    : QChartView(parent),
      xAxis_(addLabelledAxis(*chart(), Qt::AlignBottom)),
      yAxis_(addLabelledAxis(*chart(), Qt::AlignLeft)) {
    // The cells are the grid.
    xAxis_->setGridLineVisible(false);
    yAxis_->setGridLineVisible(false);
    setUpView(*this, 8);
    setFocusPolicy(Qt::NoFocus);
    setMouseTracking(true);
    viewport()->setMouseTracking(true);
    setMinimumSize(140, 90);
}

void PairMap::setCells(MapAxis across, MapAxis up, std::vector<double> shares, QStringList help) {
    across_ = std::move(across);
    up_ = std::move(up);
    shares_ = std::move(shares);
    help_ = std::move(help);
    xAxis_->setTitleText(across_.title);
    yAxis_->setTitleText(up_.title);
    setAccessibleName(tr("Success [%] over %1 and %2").arg(across_.title, up_.title));
    setAccessibleDescription(help_.join(u'\n'));
    updateTicks();
    viewport()->update();
}

void PairMap::setTheme(const ChartTheme& theme) {
    theme_ = theme;
    applyTheme(*this, theme, {xAxis_, yAxis_});
}

QRectF PairMap::cellRect(int cell) const {
    const QRectF area = chart()->plotArea();
    const double width = area.width() / columns();
    const double height = area.height() / rows();
    const int column = cell % columns();
    const int row = cell / columns();
    return {area.left() + column * width, area.bottom() - (row + 1) * height, width, height};
}

std::optional<int> PairMap::cellAt(const QPointF& position) const {
    for (int cell = 0; cell < static_cast<int>(shares_.size()); ++cell)
        if (cellRect(cell).contains(position)) return cell;
    return std::nullopt;
}

bool PairMap::viewportEvent(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        auto* const asked = static_cast<QHelpEvent*>(event);
        const std::optional<int> cell = cellAt(asked->pos());
        QToolTip::showText(asked->globalPos(), cell ? help_[*cell] : QString(), this);
        return true;
    }
    return QChartView::viewportEvent(event);
}

void PairMap::resizeEvent(QResizeEvent* event) {
    QChartView::resizeEvent(event);
    updateTicks();
}

void PairMap::mouseMoveEvent(QMouseEvent* event) {
    viewport()->setCursor(cellAt(event->position()) ? Qt::PointingHandCursor : Qt::ArrowCursor);
}

void PairMap::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    if (const auto cell = cellAt(event->position())) emit picked(*cell);
}

void PairMap::updateTicks() {
    const QRectF area = chart()->plotArea();
    const QFontMetricsF metrics(font());
    setLabels(xAxis_, across_.labels, std::max(2, static_cast<int>(area.width() / kTickSpace)));
    setLabels(yAxis_, up_.labels, std::max(2, static_cast<int>(area.height() / (1.3 * metrics.height()))));
}

/// Cut to nothing that could need clipping, which QSvgGenerator does not know.
void PairMap::drawForeground(QPainter* painter, const QRectF&) {
    double most = kLeastScale;
    for (const double share : shares_)
        most = std::max(most, kWhole - share);
    painter->save();
    painter->setFont(font());
    const QFontMetricsF metrics(font());
    for (int cell = 0; cell < static_cast<int>(shares_.size()); ++cell) {
        const double share = shares_[static_cast<std::size_t>(cell)];
        const QRectF rect = cellRect(cell);
        const QColor fill =
            mix(theme_.series(SeriesColour::second), theme_.background, kDarkest * (kWhole - share) / most);
        painter->setPen(QPen(theme_.background, 1.5));
        painter->setBrush(fill);
        painter->drawRect(rect);
        QString text = QString::number(share, 'f', share < 99.95 ? 1 : 0);
        if (metrics.horizontalAdvance(text) + 4.0 > rect.width()) text = QString::number(share, 'f', 0);
        if (metrics.horizontalAdvance(text) + 2.0 > rect.width() || metrics.height() > rect.height())
            continue;
        painter->setPen(qGray(fill.rgb()) > 135 ? Qt::black : Qt::white);
        painter->drawText(rect, Qt::AlignCenter, text);
    }
    painter->restore();
}

}  // namespace trapwright::charts
