#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace trapwright::store {

/// The file of a study as this process has it open: once, however many connections to it there are, and under
/// however many names. SQLite's locks are the process's, and the system drops all of them with any descriptor
/// of that file which the process closes. So nothing here is closed before the last of these objects, and one
/// must live from before SQLite opens the file until after it has closed it.
class OpenFile {
 public:
    /// An error if there is no such file, or it is a folder or a device, or cannot be read.
    static base::Result<OpenFile> open(const std::filesystem::path& path);

    OpenFile(OpenFile&& other) noexcept;
    OpenFile& operator=(OpenFile&& other) noexcept;
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile();

    /// Takes the right to write this file until the end of this object, whatever name it was opened by. An
    /// error if another holds it, in this process or another, or if the file cannot be written or locked.
    base::Status lockForWriting();

    /// At most `count` bytes from the beginning.
    [[nodiscard]] std::string readBeginning(std::size_t count) const;
    [[nodiscard]] std::uintmax_t size() const;
    /// How many names (hard links) it has.
    [[nodiscard]] std::uintmax_t countNames() const;

 private:
    /// Device and inode.
    using Identity = std::array<std::uint64_t, 2>;
    OpenFile(std::filesystem::path path, const Identity& identity, int descriptor);
    void release();

    std::filesystem::path path_;
    Identity identity_{};
    int descriptor_ = -1;  // of this file, shared; negative: moved from
    bool locked_ = false;
};

}  // namespace trapwright::store
