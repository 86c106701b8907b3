#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace trapwright::base {

/// The whole content of a file. An error that names the file and the system's reason; a device, a folder, or
/// more than `mostBytes`, is one, too.
Result<std::string> readFile(const std::filesystem::path& path, std::size_t mostBytes = 1ULL << 30U);

/// Puts `content` where `path` is, or leaves there what was: the content is written to a new file beside it,
/// synced and renamed, and the folder synced. An error (full disk, read-only folder) names the file and the
/// system's reason.
Status writeFile(const std::filesystem::path& path, std::string_view content);

/// Makes a rename in the folder survive a loss of power, where its file system can.
void syncFolder(const std::filesystem::path& folder);

}  // namespace trapwright::base
