#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Reads a PLY or STL (text and binary), OFF (text) or OBJ file in the unit of the file, which the formats do
/// not tell. Faces with more than three corners are triangulated by CGAL. The formats are read by our own:
/// CGAL's and assimp's readers crash on damaged files and refuse or misread whole ones. Errors name the file,
/// the place in it and what is wrong there.
base::Result<TriangleMesh> readPly(const std::filesystem::path& path);
base::Result<TriangleMesh> readOff(const std::filesystem::path& path);
base::Result<TriangleMesh> readAnyStl(const std::filesystem::path& path);
base::Result<TriangleMesh> readObj(const std::filesystem::path& path);

}  // namespace trapwright::geometry
