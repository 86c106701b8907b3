#pragma once

#include <QString>
#include <cstddef>

#include "core/geometry/mesh_check.h"
#include "core/part/part.h"
#include "ui/pages/fact_list.h"

namespace trapwright::pages {

/// What was found in the mesh as it came from the file.
Facts meshFacts(const geometry::MeshReport& report, std::size_t triangles);
/// Mass, volume, inertia and extent.
Facts massFacts(const part::Part& part);
/// "D2: 4 orientations look alike"
QString symmetryText(const part::SymmetryGroup& group);

}  // namespace trapwright::pages
