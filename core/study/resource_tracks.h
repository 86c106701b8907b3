#pragma once

#include <filesystem>
#include <string_view>

namespace trapwright::study {

/// Where a track file that comes with Trapwright is: in the folder tracks/ beside that of the bundled parts.
std::filesystem::path findResourceTrack(std::string_view file);

}  // namespace trapwright::study
