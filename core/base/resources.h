#pragma once

#include <filesystem>

namespace trapwright::base {

/// Where a file or folder is that comes with Trapwright ("parts/cuboid.stl"): in the folder that the
/// environment's TRAPWRIGHT_RESOURCES names, or share/trapwright/resources of the installation that the
/// running program belongs to, or the source tree.
std::filesystem::path findResource(const std::filesystem::path& relative);

/// Where the user keeps what is his own ("materials"), for programs without Qt; the studio's
/// QStandardPaths::AppLocalDataLocation. Empty where the environment names no home.
std::filesystem::path findOwnFolder(const std::filesystem::path& relative);

}  // namespace trapwright::base
