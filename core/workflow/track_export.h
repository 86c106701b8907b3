#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/track/track_file.h"
#include "core/workflow/failure.h"

namespace trapwright::workflow {

/// A file of a track or of a piece of it, as it was read back: closed and manifold.
struct ExportedFile {
    std::filesystem::path path;
    base::Vec3 size = base::Vec3::Zero();  // of the box around all of it [m]
    int solids = 1;
    std::size_t faces = 0;  // triangles; of a STEP file, plane faces
    bool isStep = false;
    double volume = 0.0;  // [m^3]
    int overlappingTriangles = 0;
};

/// The name of one of several files: track.stl gives track-1-of-2.stl.
std::filesystem::path pieceFile(const std::filesystem::path& path, std::size_t piece, std::size_t pieces);

/// Writes what is printed (track::buildPrintSolid, or the pieces of track::buildPrintPieces), in millimetres,
/// by the extension: binary STL and STEP (part::writeStepSolid), of several pieces a file each (pieceFile);
/// 3MF, with an object for each piece; or the track as JSON (core/track/track_file.h). Reads back what was
/// written and checks that it is closed, manifold and of the same volume: of a STEP file within 1e-6 of it.
/// Only then they take the places of files that were there; if something fails, those stay as they are.
Result<std::vector<ExportedFile>> exportTrack(const track::TrackFile& design,
                                              std::span<const geometry::TriangleMesh> solids,
                                              const std::filesystem::path& path);

}  // namespace trapwright::workflow
