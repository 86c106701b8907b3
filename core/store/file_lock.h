#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace trapwright::store {

/// The right to write one study, held for as long as this object lives. It is a lock of the system (flock) on
/// a file beside the study, `study.trap.lock`: it is gone when the process is, however that ends, and it
/// refuses a second holder in the same process too. The file itself means nothing and is removed on release.
/// The study's own file is locked as well, by OpenFile, for those who come by another name.
class FileLock {
 public:
    /// Takes the lock for the study at `path`, which need not exist. An error if another holds it (with its
    /// process id) or the folder cannot be written.
    static base::Result<FileLock> acquire(const std::filesystem::path& path);

    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    ~FileLock();

 private:
    FileLock(std::filesystem::path lockPath, int descriptor);
    void release();

    std::filesystem::path lockPath_;
    int descriptor_ = -1;
};

}  // namespace trapwright::store
