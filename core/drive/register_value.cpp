#include "core/drive/register_value.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace trapwright::drive {

namespace {

template <class Whole>
Whole toWhole(double raw) {
    const double low = std::numeric_limits<Whole>::lowest();
    const double high = std::numeric_limits<Whole>::max();
    return static_cast<Whole>(std::clamp(std::round(raw), low, high));
}

std::vector<std::uint16_t> split(std::uint32_t bits, bool lowWordFirst) {
    const auto high = static_cast<std::uint16_t>(bits >> 16U);
    const auto low = static_cast<std::uint16_t>(bits & 0xFFFFU);
    if (lowWordFirst) return {low, high};
    return {high, low};
}

}  // namespace

std::vector<std::uint16_t> encodeRaw(const Place& place, double raw) {
    if (!std::isfinite(raw)) raw = 0.0;
    switch (place.type) {
        case DataType::bit:
            return {static_cast<std::uint16_t>(raw != 0.0 ? 1 : 0)};
        case DataType::uint16:
            return {toWhole<std::uint16_t>(raw)};
        case DataType::int16:
            return {static_cast<std::uint16_t>(toWhole<std::int16_t>(raw))};
        case DataType::uint32:
            return split(toWhole<std::uint32_t>(raw), place.lowWordFirst);
        case DataType::int32:
            return split(static_cast<std::uint32_t>(toWhole<std::int32_t>(raw)), place.lowWordFirst);
        case DataType::float32:
            return split(std::bit_cast<std::uint32_t>(static_cast<float>(raw)), place.lowWordFirst);
    }
    return {};
}

double decodeRaw(const Place& place, std::span<const std::uint16_t> registers) {
    if (place.count() == 1) {
        // On the wire a coil that is on is FF00 or 1, depending on the question.
        if (place.type == DataType::bit) return registers[0] != 0 ? 1.0 : 0.0;
        if (place.type == DataType::int16) return static_cast<std::int16_t>(registers[0]);
        return registers[0];
    }
    const std::uint32_t first = registers[0];
    const std::uint32_t second = registers[1];
    const std::uint32_t bits = place.lowWordFirst ? (second << 16U | first) : (first << 16U | second);
    if (place.type == DataType::int32) return static_cast<std::int32_t>(bits);
    if (place.type == DataType::float32) return std::bit_cast<float>(bits);
    return bits;
}

std::optional<unsigned> toBits(double raw) {
    const double low = std::numeric_limits<std::int32_t>::lowest();
    const double high = std::numeric_limits<std::uint32_t>::max();
    if (!(raw >= low && raw <= high)) return std::nullopt;
    return static_cast<unsigned>(static_cast<std::int64_t>(raw));
}

double toRaw(const Quantity& quantity, double value) {
    return quantity.zero + value * (quantity.one - quantity.zero);
}

double fromRaw(const Quantity& quantity, double raw) {
    return (raw - quantity.zero) / (quantity.one - quantity.zero);
}

}  // namespace trapwright::drive
