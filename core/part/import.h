#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::part {

/// A part file as triangles in metres. Not yet checked or repaired.
struct ImportedMesh {
    geometry::TriangleMesh mesh;     // [m], axes of the file
    std::string units;               // the unit that the file was taken to be in
    bool unitsFromFile = false;      // the file or its format says so
    std::vector<std::string> notes;  // what a user should know, such as an assumed unit
};

/// Reads a part file by its extension (see supportedExtensions). `units` (um, mm, cm, m, inch, ft) overrides
/// what the file says; without it a file that does not say is taken as millimetres if that gives a part of 1
/// to 100 mm, and the notes say so. Errors: no such file, a folder, unreadable, empty, unknown extension,
/// damaged, no triangles, a coordinate that is not a number, an unknown unit, an implausible size without a
/// unit.
base::Result<ImportedMesh> importMesh(const std::filesystem::path& path,
                                      const std::optional<std::string>& units = std::nullopt);

/// The extensions that importMesh knows, lower case with the dot.
std::vector<std::string> supportedExtensions();

}  // namespace trapwright::part
