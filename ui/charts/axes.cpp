#include "ui/charts/axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

namespace trapwright::charts {

namespace {

constexpr int kFewTicks = 3;  // fewer on a logarithmic axis say too little

/// The smallest of 1, 2, 5, 10, 20 ... (times a power of ten) that is not less.
double roundStep(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        // Rounding must not make 0.2 more than 0.2.
        if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
    }
    return 10.0 * power;
}

/// How many decimals tell multiples of the step apart.
int decimalsOf(double step) {
    return std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
}

/// Multiples of the step in the range.
std::vector<double> multiples(const Range& range, double step) {
    std::vector<double> values;
    const double slack = 1e-9 * range.size();
    for (double k = std::ceil((range.low - slack) / step); k * step <= range.high + slack; k += 1.0)
        values.push_back(k * step + 0.0);  // no -0
    return values;
}

double roundStepFor(const Range& range, int most) {
    double step = roundStep(range.size() / std::max(1, most));
    while (static_cast<int>(multiples(range, step).size()) > std::max(1, most))
        step = roundStep(1.5 * step);
    return step;
}

/// Factors times powers of ten, every so many decades.
std::vector<Tick> decadeTicks(const Range& range, std::initializer_list<int> factors, int stride) {
    std::vector<Tick> ticks;
    constexpr double kSlack = 1e-9;
    for (int decade = static_cast<int>(std::floor(range.low)); decade <= range.high; ++decade) {
        if (decade % stride != 0) continue;
        for (const int factor : factors) {
            const double position = decade + std::log10(factor);
            if (position < range.low - kSlack || position > range.high + kSlack) continue;
            ticks.push_back(
                {position, QString::number(factor * std::pow(10.0, decade), 'f', std::max(0, -decade))});
        }
    }
    return ticks;
}

}  // namespace

std::vector<Tick> linearTicks(const Range& range, int most, double leastStep) {
    if (!(range.size() > 0.0)) return {};
    const double step = std::max(leastStep, roundStepFor(range, most));
    std::vector<Tick> ticks;
    for (const double value : multiples(range, step))
        ticks.push_back({value, QString::number(value, 'f', decimalsOf(step))});
    return ticks;
}

std::vector<Tick> logarithmicTicks(const Range& range, int most) {
    if (!(range.size() > 0.0)) return {};
    const auto fits = [&](const std::vector<Tick>& ticks) { return static_cast<int>(ticks.size()) <= most; };
    std::vector<Tick> ticks = decadeTicks(range, {1, 2, 5}, 1);
    if (static_cast<int>(ticks.size()) < kFewTicks) {
        // Within a fraction of a decade the scale is nearly linear.
        const Range values{std::pow(10.0, range.low), std::pow(10.0, range.high)};
        ticks = linearTicks(values, most);
        for (Tick& tick : ticks)
            tick.position = std::log10(tick.position);
        return ticks;
    }
    for (int stride = 1; !fits(ticks) && stride < 100; ++stride)
        ticks = decadeTicks(range, {1}, stride);
    return ticks;
}

void Extent::add(double value) {
    if (!std::isfinite(value)) return;
    if (!range_) range_ = Range{value, value};
    range_->low = std::min(range_->low, value);
    range_->high = std::max(range_->high, value);
}

std::optional<Range> Extent::range(double leastSize, double padding) const {
    if (!range_) return std::nullopt;
    const double middle = (range_->low + range_->high) / 2.0;
    const double half = std::max(range_->size(), leastSize) / 2.0 * (1.0 + 2.0 * padding);
    return Range{middle - half, middle + half};
}

Range zoomRange(const Range& range, double anchor, double factor, const Range& limits, double leastSize) {
    const double size = std::max(range.size() * factor, leastSize);
    if (size >= limits.size()) return limits;
    const double share = std::clamp((anchor - range.low) / range.size(), 0.0, 1.0);
    const double low = std::clamp(anchor - share * size, limits.low, limits.high - size);
    return {low, low + size};
}

Range shiftRange(const Range& range, double distance, const Range& limits) {
    const double size = range.size();
    if (size >= limits.size()) return limits;
    const double low = std::clamp(range.low + distance, limits.low, limits.high - size);
    return {low, low + size};
}

}  // namespace trapwright::charts
