#pragma once

#include <optional>

#include "core/part/part.h"

namespace trapwright::peers {

/// Half the sizes of a part that is a box along its own axes, which both simulators treat better than any
/// other solid. [m]
std::optional<base::Vec3> findBox(const part::Part& part);

}  // namespace trapwright::peers
