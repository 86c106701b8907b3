#pragma once

#include <QString>
#include <QVariant>

#include "core/stats/binomial.h"

/// Numbers as the tables show them.
namespace trapwright::models {

/// With so many decimals; never "-0".
QString fixed(double value, int decimals);
/// "99.4", in percent; a dash without trials.
QString percent(int successes, int trials);
/// "98.7 … 99.8", in percent; a dash without trials.
QString boundsText(const stats::Interval& bounds, int trials);
/// In percent; nothing without trials.
QVariant percentValue(int successes, int trials);

}  // namespace trapwright::models
