#include "core/evolution/gray.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace trapwright::evolution {

Bits encodeGray(std::span<const double> values, int bitsPerValue) {
    assert(bitsPerValue >= 1 && bitsPerValue <= 31);
    const double largest = static_cast<double>((std::uint32_t{1} << bitsPerValue) - 1);
    Bits bits;
    bits.reserve(values.size() * static_cast<std::size_t>(bitsPerValue));
    for (const double value : values) {
        const auto number = static_cast<std::uint32_t>(std::round(std::clamp(value, 0.0, 1.0) * largest));
        const std::uint32_t gray = number ^ (number >> 1U);
        for (int k = bitsPerValue - 1; k >= 0; --k)
            bits.push_back(static_cast<std::uint8_t>((gray >> k) & 1U));
    }
    return bits;
}

std::vector<double> decodeGray(std::span<const std::uint8_t> bits, int bitsPerValue) {
    assert(bitsPerValue >= 1 && bitsPerValue <= 31);
    const auto step = static_cast<std::size_t>(bitsPerValue);
    assert(bits.size() % step == 0);
    const double largest = static_cast<double>((std::uint32_t{1} << bitsPerValue) - 1);
    std::vector<double> values;
    values.reserve(bits.size() / step);
    for (std::size_t first = 0; first < bits.size(); first += step) {
        // Every binary digit is the parity of the Gray digits down to it.
        std::uint32_t number = 0;
        std::uint32_t digit = 0;
        for (std::size_t k = 0; k < step; ++k) {
            digit ^= bits[first + k];
            number = (number << 1U) | digit;
        }
        values.push_back(number / largest);
    }
    return values;
}

}  // namespace trapwright::evolution
