#pragma once

#include <filesystem>
#include <span>

#include "core/base/math.h"
#include "core/base/result.h"

namespace trapwright::part {

/// Writes the solid between a polygon in the x-y plane and its copy at z = depth as a STEP file in
/// millimetres. [m] The file depends on the shape and OpenCASCADE's version only, not on the time. Error: it
/// cannot be written.
base::Status writeStepPrism(const std::filesystem::path& path, std::span<const base::Vec2> polygon,
                            double depth);

}  // namespace trapwright::part
