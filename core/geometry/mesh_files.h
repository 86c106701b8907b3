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

/// Writes a binary STL in millimetres (single precision), whole or not at all. Triangles that single
/// precision flattens are left out. Errors: no triangles, coordinates that are not finite, and whatever keeps
/// the file from being written.
base::Status writeStl(const std::filesystem::path& path, const TriangleMesh& mesh);

/// Reads a binary STL in millimetres back; corners with equal coordinates become one vertex. For parts from
/// elsewhere, whose unit and flavour are open, use the part import. Errors name the file and what is wrong
/// with it.
base::Result<TriangleMesh> readStl(const std::filesystem::path& path);

}  // namespace trapwright::geometry
