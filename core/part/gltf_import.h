#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/part/file_mesh.h"

namespace trapwright::part {

/// The triangles of a glTF 2.0 file (.gltf, .glb) through assimp, all nodes of its scene in their places, in
/// metres. Buffers are read only from regular files in the file's own folder. Errors name the file.
base::Result<FileMesh> readGltfFile(const std::filesystem::path& path);

}  // namespace trapwright::part
