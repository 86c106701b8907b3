#pragma once

#include <QAbstractAxis>
#include <QChartView>
#include <initializer_list>

#include "ui/charts/chart_theme.h"

class QCategoryAxis;

/// What all plots share that Qt Charts draws.
namespace trapwright::charts {

/// No frame, no legend, nothing animated, and little room around it.
void setUpView(QChartView& view, int rightMargin);
/// An axis whose labels are at their values.
QCategoryAxis* addLabelledAxis(QChart& chart, Qt::Alignment side);
void applyTheme(QChartView& view, const ChartTheme& theme, std::initializer_list<QAbstractAxis*> axes);

}  // namespace trapwright::charts
