#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Reads a PLY (ASCII and binary) or OFF file through CGAL, in the unit of the file, which the formats do not
/// tell. Faces with more than three corners are triangulated. CGAL and not assimp, which crashes on damaged
/// files of these formats or takes them for whole. Errors name the file: damaged or cut short, a face with a
/// vertex that is not there.
base::Result<TriangleMesh> readPly(const std::filesystem::path& path);
base::Result<TriangleMesh> readOff(const std::filesystem::path& path);

}  // namespace trapwright::geometry
