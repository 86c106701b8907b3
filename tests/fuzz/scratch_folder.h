#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace trapwright::fuzz {

/// A folder of this process in memory, where there is such a file system, for readers that want a path. Gone
/// with the process, unless that crashes.
class ScratchFolder {
 public:
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();

    /// Makes this file the only one of the folder.
    std::filesystem::path keepOnly(std::string_view name, std::span<const std::uint8_t> content) const;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
    void clear() const;

    std::filesystem::path path_;
};

/// Ends the process, so that the fuzzer keeps the input, where something does not hold that must.
void require(bool holds, const char* what);

}  // namespace trapwright::fuzz
