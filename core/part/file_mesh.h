#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"
#include "core/part/units.h"

namespace trapwright::part {

/// What a file holds, before anything was decided about its units.
struct FileMesh {
    geometry::TriangleMesh mesh;  // coordinates in `unit`, or in whatever the file meant where that is empty
    std::optional<LengthUnit> unit;  // as the file or its format declares it
    std::vector<std::string> notes;  // what a user should know about how it was read
};

}  // namespace trapwright::part
