#include "ui/models/numbers.h"

#include <cmath>

namespace trapwright::models {

namespace {

constexpr double kPercent = 100.0;
const QString kNothing = QStringLiteral("–");

}  // namespace

QString fixed(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);
    // A small negative number would be written as -0.
    const double shown = std::abs(value) * scale < 0.5 ? 0.0 : value;
    return QString::number(shown, 'f', decimals);
}

QString percent(int successes, int trials) {
    if (trials == 0) return kNothing;
    return fixed(kPercent * successes / trials, 1);
}

QString boundsText(const stats::Interval& bounds, int trials) {
    if (trials == 0) return kNothing;
    return QStringLiteral("%1 … %2").arg(fixed(kPercent * bounds.low, 1), fixed(kPercent * bounds.high, 1));
}

QVariant percentValue(int successes, int trials) {
    if (trials == 0) return {};
    return kPercent * successes / trials;
}

}  // namespace trapwright::models
