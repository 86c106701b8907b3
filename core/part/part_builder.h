#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/part/part.h"
#include "core/part/symmetry.h"

namespace trapwright::part {

struct PartOptions {
    std::string name{};
    std::string source{};     // the file, as to be shown
    double density = 1040.0;  // [kg/m^3]
    double symmetryTolerance = SymmetryOptions{}.tolerance;
    SymmetryUse symmetry = SymmetryUse::found;
};

/// A part and what was found and mended on the way.
struct PreparedPart {
    Part part;
    std::vector<std::string> notes;
};

/// Called with what begins: "mending the mesh", "convex pieces", "symmetry", "stable poses".
using BuildProgress = std::function<void(std::string_view stage)>;

/// Makes a part of a mesh in metres: repairs it, computes mass properties, moves the origin to the centre of
/// mass (the file's axes are kept) and finds hull, convex pieces, symmetry and stable poses. Of fine or
/// finely curved surfaces hull and pieces are simplified, with a note that tells by how much; mesh and mass
/// properties never are. Errors: a density or tolerance out of range, a mesh that cannot be mended, no
/// volume.
base::Result<PreparedPart> buildPart(const geometry::TriangleMesh& mesh, const PartOptions& options,
                                     const BuildProgress& begin = {});

}  // namespace trapwright::part
