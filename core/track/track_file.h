#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/track/track.h"

namespace trapwright::track {

/// A track as kept in a file meant for people: JSON in millimetres (core/track/README.md tells the keys).
struct TrackFile {
    std::string about;  // where the track comes from
    Track track;
    /// Of the part at the finish (decisions.md#track-frame).
    std::optional<base::Quaternion> expectedOrientation;
};

/// The file's text. The lead-in's first section is told by its x alone: it equals the second.
std::string trackToJson(const TrackFile& file);
/// Reads what trackToJson writes and builds the solid. An error names the first key that is missing or wrong.
base::Result<TrackFile> trackFromJson(const std::string& text);

/// An error names the file and what is wrong in it.
base::Result<TrackFile> readTrackFile(const std::filesystem::path& path);
/// Replaces the file as a whole or not at all.
base::Status writeTrackFile(const std::filesystem::path& path, const TrackFile& file);

}  // namespace trapwright::track
