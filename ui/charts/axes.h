#pragma once

#include <QString>

#include <optional>
#include <vector>

namespace trapwright::charts {

/// A part of an axis; low < high.
struct Range {
    double low = 0.0;
    double high = 1.0;

    [[nodiscard]] double size() const { return high - low; }
    [[nodiscard]] bool contains(double value) const { return value >= low && value <= high; }
    friend bool operator==(const Range&, const Range&) = default;
};

/// From the least to the greatest of what was added, nothing if nothing finite was.
class Extent {
 public:
    void add(double value);
    /// At least `leastSize` wide about its middle, with `padding` (a share of its size) added at both ends.
    [[nodiscard]] std::optional<Range> range(double leastSize, double padding) const;

 private:
    std::optional<Range> range_;
};

/// The range with its size times `factor` about `anchor`, which stays where it is on the screen. Within
/// `limits`, and not smaller than `leastSize`.
Range zoomRange(const Range& range, double anchor, double factor, const Range& limits, double leastSize);

/// The range moved by `distance`, as far as `limits` allow.
Range shiftRange(const Range& range, double distance, const Range& limits);

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
