#pragma once

#include <filesystem>

namespace trapwright::base {

/// Where a file or folder is that comes with Trapwright ("parts/cuboid.stl"): in the folder that the
/// environment's TRAPWRIGHT_RESOURCES names, or share/trapwright/resources of the installation that the
/// running program belongs to, or the source tree.
std::filesystem::path findResource(const std::filesystem::path& relative);

}  // namespace trapwright::base
