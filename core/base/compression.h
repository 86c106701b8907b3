#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace trapwright::base {

/// These parts as one row of bytes, smaller (Zstandard) and with a checksum. Each part is compressed by
/// itself: what is alike belongs into one.
std::string compress(std::span<const std::string> parts);

/// The parts, one after the other. None if the bytes are damaged, or are not `size` bytes unpacked; no more
/// than that is ever made of them.
std::optional<std::string> decompress(std::string_view bytes, std::size_t size);

}  // namespace trapwright::base
