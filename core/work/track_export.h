#pragma once

#include <filesystem>
#include <string>

#include "core/geometry/mesh_check.h"
#include "core/track/track_file.h"
#include "core/work/failure.h"

namespace trapwright::work {

/// A file for printing, as it was read back.
struct ExportedFile {
    std::filesystem::path path;
    base::Vec3 size = base::Vec3::Zero();  // of its box [m]
    std::size_t triangles = 0;
    geometry::MeshReport report;
};

/// Writes the solid that is printed (track::buildPrintSolid) as binary STL or 3MF, or the track as JSON
/// (core/track/track_file.h), by the extension, in millimetres; reads it back and checks that it is closed,
/// manifold and of the same volume. What fails that check is removed again.
Result<ExportedFile> exportTrack(const track::TrackFile& design, const geometry::TriangleMesh& solid,
                                 const std::filesystem::path& path);

}  // namespace trapwright::work
