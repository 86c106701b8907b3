#pragma once

#include <string>

namespace trapwright::base {

/// A field of a CSV line, with quotes if it needs them (RFC 4180).
std::string csvField(const std::string& text);

}  // namespace trapwright::base
