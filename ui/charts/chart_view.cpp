#include "ui/charts/chart_view.h"

#include <QCategoryAxis>
#include <QChart>
#include <QGraphicsLayout>

namespace trapwright::charts {

void setUpView(QChartView& view, int rightMargin) {
    view.setFrameShape(QFrame::NoFrame);
    view.setRenderHint(QPainter::Antialiasing);
    view.setViewportUpdateMode(QGraphicsView::FullViewportUpdate);
    QChart& chart = *view.chart();
    chart.legend()->hide();
    chart.setMargins(QMargins(2, 4, rightMargin, 2));
    chart.layout()->setContentsMargins(0, 0, 0, 0);
    chart.setBackgroundRoundness(0.0);
    chart.setBackgroundPen(Qt::NoPen);
    chart.setAnimationOptions(QChart::NoAnimation);
}

QCategoryAxis* addLabelledAxis(QChart& chart, Qt::Alignment side) {
    auto* axis = new QCategoryAxis(&chart);
    axis->setLabelsPosition(QCategoryAxis::AxisLabelsPositionOnValue);
    axis->setTruncateLabels(false);
    chart.addAxis(axis, side);
    return axis;
}

void applyTheme(QChartView& view, const ChartTheme& theme, std::initializer_list<QAbstractAxis*> axes) {
    view.chart()->setBackgroundBrush(theme.background);
    view.setBackgroundBrush(theme.background);
    QFont titleFont = view.font();
    titleFont.setBold(false);
    for (QAbstractAxis* axis : axes) {
        axis->setLabelsColor(theme.text);
        axis->setLabelsFont(view.font());
        axis->setTitleBrush(theme.faintText);
        axis->setTitleFont(titleFont);
        axis->setLinePen(QPen(theme.axis, 1.0));
        axis->setGridLinePen(QPen(theme.grid, 1.0));
    }
    view.viewport()->update();
}

}  // namespace trapwright::charts
