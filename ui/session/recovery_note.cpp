#include "ui/session/recovery_note.h"

#include <unistd.h>

#include "core/base/file.h"

namespace trapwright::session {

namespace {

constexpr const char* kPrefix = "learning-";
constexpr const char* kSuffix = ".note";

/// A name that no other note of any process has.
std::filesystem::path chooseFile(const std::filesystem::path& folder) {
    std::error_code missing;
    for (int number = 0;; ++number) {
        std::filesystem::path file =
            folder / (kPrefix + std::to_string(::getpid()) + "-" + std::to_string(number) + kSuffix);
        if (!std::filesystem::exists(file, missing)) return file;
    }
}

bool isNote(const std::filesystem::path& file) {
    return file.extension() == kSuffix && file.filename().string().rfind(kPrefix, 0) == 0;
}

}  // namespace

RecoveryNote::RecoveryNote(const std::filesystem::path& stateFolder, const std::filesystem::path& study) {
    if (stateFolder.empty()) return;
    std::error_code failure;
    std::filesystem::create_directories(stateFolder, failure);
    file_ = chooseFile(stateFolder);
    if (auto lock = store::FileLock::acquire(file_)) lock_ = std::move(*lock);
    (void)base::writeFile(file_, std::filesystem::absolute(study).string());
}

RecoveryNote::~RecoveryNote() {
    std::error_code failure;
    if (!file_.empty()) std::filesystem::remove(file_, failure);
}

std::vector<std::filesystem::path> takeInterruptedStudies(const std::filesystem::path& stateFolder) {
    std::vector<std::filesystem::path> studies;
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(stateFolder, failure)) {
        if (!isNote(entry.path())) continue;
        // The system dropped the lock when that program ended, however it ended.
        const auto lock = store::FileLock::acquire(entry.path());
        if (!lock) continue;
        const auto study = base::readFile(entry.path());
        std::filesystem::remove(entry.path(), failure);
        if (study && std::filesystem::exists(*study, failure)) studies.emplace_back(*study);
    }
    return studies;
}

}  // namespace trapwright::session
