#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/store/file_lock.h"

namespace trapwright::session {

/// Tells the next start of the program that a study was learning, should this one end badly: a small file in
/// the program's state folder, there as long as this object lives.
class RecoveryNote {
 public:
    /// Nothing happens if the folder cannot be written: learning does not depend on this.
    RecoveryNote(const std::filesystem::path& stateFolder, const std::filesystem::path& study);
    RecoveryNote(const RecoveryNote&) = delete;
    RecoveryNote& operator=(const RecoveryNote&) = delete;
    ~RecoveryNote();

 private:
    std::filesystem::path file_;
    std::optional<store::FileLock> lock_;
};

/// The studies that were learning when a program that is gone ended badly, and that still exist. Forgets
/// them: they are told once.
std::vector<std::filesystem::path> takeInterruptedStudies(const std::filesystem::path& stateFolder);

}  // namespace trapwright::session
