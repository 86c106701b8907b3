#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace trapwright::part {

/// Whether a file can be an STL file at all: a binary one of exactly the size that its header announces, or
/// an ASCII one that has facets and an end. Error: says whether it is some other text, cut short, or damaged.
base::Status checkStlFile(const std::filesystem::path& path);

}  // namespace trapwright::part
