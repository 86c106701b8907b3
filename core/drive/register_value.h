#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/drive/profile.h"

namespace trapwright::drive {

/// The raw number as registers (or one coil). What does not fit the type becomes the nearest number that
/// does.
std::vector<std::uint16_t> encodeRaw(const Place& place, double raw);
/// The raw number of as many registers as the place takes.
double decodeRaw(const Place& place, std::span<const std::uint16_t> registers);

/// The bits of a raw number that stands for a switch or a code; of a negative one those of its complement on
/// two. None where it has none: no number, or one past 32 bits.
std::optional<unsigned> toBits(double raw);

/// From a quantity to its raw number and back.
double toRaw(const Quantity& quantity, double value);
double fromRaw(const Quantity& quantity, double raw);

}  // namespace trapwright::drive
