#pragma once

#include <QString>
#include <vector>

#include "ui/charts/view_range.h"

namespace trapwright::charts {

/// A labelled place on an axis, in the axis's own coordinate: log10 of the value on a logarithmic one.
struct Tick {
    double position = 0.0;
    QString label;

    friend bool operator==(const Tick&, const Tick&) = default;
};

/// Round numbers (1, 2 or 5 times a power of ten apart) within the range, as dense as `most` allows; at least
/// `leastStep` apart: 1 gives whole numbers.
std::vector<Tick> linearTicks(const Range& range, int most, double leastStep = 0.0);

/// Powers of ten, with 2 and 5 times those between them as far as `most` allows; round numbers where the
/// range is less than that. `range` is of log10 of the value.
std::vector<Tick> logarithmicTicks(const Range& range, int most);

}  // namespace trapwright::charts
