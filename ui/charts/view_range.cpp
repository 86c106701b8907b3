#include "ui/charts/view_range.h"

#include <algorithm>
#include <cmath>

namespace trapwright::charts {

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
