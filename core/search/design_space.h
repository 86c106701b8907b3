#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/random.h"
#include "core/base/result.h"

namespace trapwright::search {

/// A candidate as a search sees it: a number in [0, 1] for each dimension of a design space. What it stands
/// for is no business of this folder.
using Design = std::vector<double>;

/// One number of a design.
struct Dimension {
    std::string key;   // one of a kind within the space: "section 2, point 5, z"
    std::string unit;  // of low and high: "mm"; may be empty
    double low = 0.0;  // what 0 stands for
    double high = 1.0;
    /// How finely it is told apart: only k / (2^bits - 1), k = 0 ... 2^bits - 1, at most 31 bits. 0: any
    /// number.
    int bits = 0;
    /// One of the two numbers of a point in a plane. Such dimensions come in twos, with equally many bits; a
    /// search may change both at once.
    bool ofPoint = false;
    /// 0.5 in all such dimensions is level; the farther from it, the rougher the design.
    bool isRelief = false;
    /// Where it is drawn: dimensions of one line belong together, as those of a cross-section do.
    int line = 0;
};

/// Evens a design out: whatever is rough becomes smooth with a probability, for each thing that can be
/// smoothed. Numbers that it leaves keep their value to the last bit.
using SmoothDesign = std::function<Design(Design design, double probability, base::Random& random)>;

/// What there is to choose from.
struct DesignSpace {
    std::vector<Dimension> dimensions;
    SmoothDesign smooth{};  // may be empty: there is nothing to be smoothed

    /// An error if the design has not as many numbers as the space has dimensions, or one is not in [0, 1].
    [[nodiscard]] base::Status check(const Design& design) const;
};

/// The nearest number that a dimension of so many bits can have; the value itself for 0 bits.
double roundToBits(double value, int bits);

/// A number at random; of relief one in four is level.
double drawNumber(const Dimension& dimension, base::Random& random);

/// Changes one to three numbers, of these dimensions: by 1 to 25 % of their range (standard deviation), one
/// in seven drawn anew.
void mutateNumbers(std::span<double> numbers, std::span<const Dimension> dimensions, base::Random& random);

/// Bytes that give the design back to the last bit, in any space: its numbers with the fewest bits that all
/// of them can be told with, up to 24, or as doubles. A count (32 bits), the bits of a number (8, 0: a
/// double), then the numbers one after the other, the lowest bit first.
std::string packDesign(const Design& design);
/// None if the bytes are not what packDesign writes.
std::optional<Design> unpackDesign(std::string_view bytes);

}  // namespace trapwright::search
