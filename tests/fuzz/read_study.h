#pragma once

#include <filesystem>

namespace trapwright::fuzz {

/// Opens a study for reading, if it is one, and reads all that it holds.
void readWholeStudy(const std::filesystem::path& path);

}  // namespace trapwright::fuzz
