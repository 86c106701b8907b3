#pragma once

#include "core/part/file_mesh.h"

namespace trapwright::part {

/// Reads a STEP or IGES file through OpenCASCADE and tessellates all its solids and faces in the file's unit.
/// The chords are within 1/1000 of the part's size of the true surface, and a circle gets at least 36 of
/// them. Error: OpenCASCADE cannot read it, or it has no surfaces.
base::Result<FileMesh> readStepFile(const std::filesystem::path& path);
base::Result<FileMesh> readIgesFile(const std::filesystem::path& path);

}  // namespace trapwright::part
