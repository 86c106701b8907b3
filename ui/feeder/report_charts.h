#pragma once

#include <QImage>

#include "core/study/physical_table.h"
#include "core/study/physical_validation.h"

/// The charts of a report: black on white, told apart by shape as well as colour.
namespace trapwright::feeder {

/// Success rates with their 95 % bounds (Clopper and Pearson) by pose, simulated beside real.
/// `feeder`: its name in the legend.
QImage successChart(const study::PhysicalTable& table, const QString& feeder, QSize pixels);

/// The success rate over the course of the trials with its 95 % bounds (Clopper and Pearson); failures are
/// marked.
QImage courseChart(const study::PhysicalValidation& validation, QSize pixels);

}  // namespace trapwright::feeder
