#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"
#include "core/part/part_builder.h"

namespace trapwright::work {

/// How the user names a part and tells what its file does not.
struct PartRequest {
    std::string part;                    // bundled name or file
    std::optional<std::string> units{};  // of the file
    std::optional<double> density{};     // [kg/m^3]; without it a bundled part's own, or the default
    std::optional<double> tolerance{};   // of the symmetry, as a share of the part's size
};

/// A unit that a file could be in, and the size that the part would have.
struct UnitCandidate {
    std::string name;                      // um, mm, cm, m, inch or ft
    base::Vec3 size = base::Vec3::Zero();  // [m]
};

/// What was found in a part file and mended.
struct PartReport {
    std::string units;           // that the file was taken to be in
    bool unitsFromFile = false;  // the file or its format says so
    bool bundled = false;
    std::vector<UnitCandidate> candidates;  // all units with the size under each
    std::vector<std::string> notes;         // as sentences
};

}  // namespace trapwright::work
