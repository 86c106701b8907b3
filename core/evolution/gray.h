#pragma once

#include <span>
#include <vector>

#include "core/evolution/chromosome.h"

namespace trapwright::evolution {

/// Each value in [0, 1] as `bitsPerValue` bits of reflected binary code (Gray code; paper, section 4.2), most
/// significant first: the whole number nearest to value x (2^bits - 1). At most 31 bits.
Bits encodeGray(std::span<const double> values, int bitsPerValue);

/// The inverse: whole number / (2^bits - 1). encodeGray(decodeGray(bits)) = bits.
std::vector<double> decodeGray(std::span<const std::uint8_t> bits, int bitsPerValue);

}  // namespace trapwright::evolution
