#pragma once

#include <filesystem>
#include <string>

#include "app/trapwright/exit_codes.h"
#include "core/geometry/mesh_check.h"
#include "core/track/track_file.h"

namespace trapwright::app {

/// A file for printing, as it was read back.
struct ExportedFile {
    std::filesystem::path path;
    base::Vec3 size = base::Vec3::Zero();  // of its box [m]
    std::size_t triangles = 0;
    geometry::MeshReport report;
};

/// Writes the track's solid as binary STL or 3MF, or the track as JSON (core/track/track_file.h), by the
/// extension, in millimetres; reads it back and checks that it is closed, manifold and of the same volume.
/// What fails that check is removed again.
Attempt<ExportedFile> exportTrack(const track::TrackFile& design, const std::filesystem::path& path);

/// A sentence about the file for people.
std::string describeExport(const ExportedFile& file);

}  // namespace trapwright::app
