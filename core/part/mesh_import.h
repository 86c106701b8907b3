#pragma once

#include "core/part/file_mesh.h"

namespace trapwright::part {

/// Reads a mesh file through assimp: STL (ASCII and binary), OBJ, glTF. All meshes of the scene are
/// joined with the transforms of their nodes; lines and points are left out. No unit: assimp does not tell.
/// Error: assimp cannot read it.
base::Result<FileMesh> readMeshFile(const std::filesystem::path& path);

}  // namespace trapwright::part
