#pragma once

#include <string_view>

#include "core/base/result.h"

namespace trapwright::geometry {

/// Whether a zip package unpacks to a size that is safe to read: at most 512 MiB in all, and none of its
/// files to more than it says. Refuses packages made to fill the memory ("zip bombs") before anything is
/// unpacked into it. Errors are the reason only.
base::Status checkPackageSize(std::string_view package);

}  // namespace trapwright::geometry
