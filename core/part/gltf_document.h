#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace trapwright::part {

/// A glTF file that is fit for a reader.
struct GltfDocument {
    std::string bytes;          // what of the file places triangles
    bool isBinary = false;      // a GLB
    std::size_t triangles = 0;  // of all meshes, each counted once
};

/// Checks what a reader of glTF 2.0 (Khronos, The glTF 2.0 Specification, 2021) relies on: chunks of a GLB,
/// JSON of sane depth, version, extensions, a tree of nodes, types and lengths of accessors. Chunks that are
/// not aligned are moved, a file without scenes gets one of all its nodes, and all but the shape is left out.
/// Errors are the reason only.
base::Result<GltfDocument> checkGltf(std::string_view bytes);

}  // namespace trapwright::part
