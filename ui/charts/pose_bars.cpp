#include "ui/charts/pose_bars.h"

#include <QBarCategoryAxis>
#include <QBarSet>
#include <QCategoryAxis>
#include <QChart>
#include <QHorizontalStackedBarSeries>
#include <algorithm>

#include "ui/charts/axes.h"
#include "ui/charts/chart_view.h"

namespace trapwright::charts {

namespace {

constexpr double kBarWidth = 0.62;  // share of the room of a bar
constexpr Range kWhole{0.0, 100.0};
constexpr double kTickSpace = 48.0;

}  // namespace

PoseBars::PoseBars(QWidget* parent)
    : QChartView(parent),
      series_(new QHorizontalStackedBarSeries(chart())),
      barAxis_(new QBarCategoryAxis(chart())),
      shareAxis_(new QCategoryAxis(chart())) {
    setUpView(*this, 14);
    setFocusPolicy(Qt::NoFocus);
    setMinimumSize(120, 90);
    chart()->addSeries(series_);
    series_->setBarWidth(kBarWidth);
    shareAxis_->setLabelsPosition(QCategoryAxis::AxisLabelsPositionOnValue);
    shareAxis_->setTitleText(tr("Parts by nearest stable pose [%]"));
    barAxis_->setGridLineVisible(false);
    barAxis_->setLineVisible(false);
    chart()->addAxis(barAxis_, Qt::AlignLeft);
    chart()->addAxis(shareAxis_, Qt::AlignBottom);
    series_->attachAxis(barAxis_);
    series_->attachAxis(shareAxis_);
    setAccessibleName(shareAxis_->titleText());
}

void PoseBars::setBars(std::vector<PoseBar> bars, const QStringList& names,
                       const std::vector<SeriesColour>& colours) {
    bars_ = std::move(bars);
    names_ = names;
    colours_ = colours;
    series_->clear();
    // Qt Charts counts bars from the bottom.
    const std::vector<PoseBar> upwards(bars_.rbegin(), bars_.rend());
    QStringList categories;
    for (const PoseBar& bar : upwards)
        categories.append(bar.name);
    barAxis_->clear();
    barAxis_->append(categories);
    for (qsizetype i = 0; i < names_.size(); ++i) {
        auto* set = new QBarSet(names_[i]);
        for (const PoseBar& bar : upwards)
            set->append(bar.shares[static_cast<std::size_t>(i)]);
        series_->append(set);
    }
    QStringList spoken;
    for (const PoseBar& bar : bars_) {
        for (qsizetype i = 0; i < names_.size(); ++i) {
            spoken.append(tr("%1, %2: %3 %")
                              .arg(bar.name, names_[i],
                                   QString::number(bar.shares[static_cast<std::size_t>(i)], 'f', 1)));
        }
    }
    setAccessibleDescription(spoken.join(u'\n'));
    updateColours();
    updateTicks();
}

void PoseBars::setTheme(const ChartTheme& theme) {
    theme_ = theme;
    applyTheme(*this, theme, {barAxis_, shareAxis_});
    updateColours();
}

void PoseBars::updateColours() {
    const QList<QBarSet*> sets = series_->barSets();
    for (qsizetype i = 0; i < sets.size(); ++i) {
        sets[i]->setBrush(theme_.series(colours_[static_cast<std::size_t>(i)]));
        sets[i]->setPen(QPen(theme_.background, 1.5));
    }
    viewport()->update();
}

void PoseBars::updateTicks() {
    const auto most = static_cast<int>(chart()->plotArea().width() / kTickSpace);
    for (const QString& old : shareAxis_->categoriesLabels())
        shareAxis_->remove(old);
    shareAxis_->setRange(kWhole.low, kWhole.high);
    shareAxis_->setStartValue(-kWhole.size());
    for (const Tick& tick : linearTicks(kWhole, std::max(2, most)))
        shareAxis_->append(tick.label, tick.position);
}

void PoseBars::resizeEvent(QResizeEvent* event) {
    QChartView::resizeEvent(event);
    updateTicks();
}

/// The share inside each piece that has room for it.
void PoseBars::drawForeground(QPainter* painter, const QRectF&) {
    const QRectF area = chart()->plotArea();
    painter->save();
    painter->setFont(font());
    const QFontMetricsF metrics(font());
    const double room = area.height() / static_cast<double>(std::max<std::size_t>(1, bars_.size()));
    for (std::size_t b = 0; b < bars_.size(); ++b) {
        double from = 0.0;
        for (std::size_t i = 0; i < bars_[b].shares.size(); ++i) {
            const double share = bars_[b].shares[i];
            const QRectF piece(area.left() + from / kWhole.size() * area.width(),
                               area.top() + static_cast<double>(b) * room,
                               share / kWhole.size() * area.width(), room);
            from += share;
            const QString text = QString::number(share, 'f', share < 99.95 && share > 0.0 ? 1 : 0);
            if (metrics.horizontalAdvance(text) + 4.0 > piece.width()) continue;
            const QColor fill = theme_.series(colours_[i]);
            painter->setPen(qGray(fill.rgb()) > 135 ? Qt::black : Qt::white);
            painter->drawText(piece, Qt::AlignCenter, text);
        }
    }
    painter->restore();
}

}  // namespace trapwright::charts
