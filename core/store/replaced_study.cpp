#include "core/store/replaced_study.h"

#include <array>
#include <string>
#include <system_error>
#include <utility>

#include "core/store/file_lock.h"

namespace trapwright::store {

namespace {

// A study, and what SQLite keeps beside it while it is open.
constexpr std::array kFiles = {"", "-wal", "-shm"};

/// A name beside the study that nobody has.
std::filesystem::path findAside(const std::filesystem::path& path) {
    std::filesystem::path aside;
    std::error_code missing;
    int number = 0;
    do {
        aside = path.string() + ".replaced" + (number == 0 ? "" : "-" + std::to_string(number));
        ++number;
    } while (std::filesystem::exists(std::filesystem::symlink_status(aside, missing)));
    return aside;
}

/// Moves those of a study's files that there are. The study itself first: without it nothing is moved.
std::error_code moveFiles(const std::filesystem::path& from, const std::filesystem::path& to) {
    for (const char* suffix : kFiles) {
        const std::filesystem::path file = from.string() + suffix;
        std::error_code failure;
        if (!std::filesystem::exists(std::filesystem::symlink_status(file, failure))) continue;
        std::filesystem::rename(file, to.string() + suffix, failure);
        if (failure) return failure;
    }
    return {};
}

}  // namespace

base::Result<ReplacedStudy> ReplacedStudy::setAside(const std::filesystem::path& path) {
    std::error_code missing;
    const auto status = std::filesystem::symlink_status(path, missing);
    if (!std::filesystem::exists(status)) return ReplacedStudy(std::nullopt);
    if (std::filesystem::is_directory(status)) {
        return base::Error{path.string() + " is a folder and cannot be replaced. Choose another name."};
    }
    const auto lock = FileLock::acquire(path);
    if (!lock) return lock.error();
    std::filesystem::path aside = findAside(path);
    if (const std::error_code failure = moveFiles(path, aside)) {
        return base::Error{path.string() + " cannot be replaced (" + failure.message() +
                           "). Choose another name or folder."};
    }
    return ReplacedStudy(Moved{path, std::move(aside)});
}

ReplacedStudy::ReplacedStudy(std::optional<Moved> moved) : moved_(std::move(moved)) {}

ReplacedStudy::ReplacedStudy(ReplacedStudy&& other) noexcept : moved_(std::exchange(other.moved_, {})) {}

ReplacedStudy::~ReplacedStudy() {
    if (moved_) moveFiles(moved_->aside, moved_->path);
}

void ReplacedStudy::discard() {
    if (!moved_) return;
    for (const char* suffix : kFiles) {
        std::error_code ignored;
        std::filesystem::remove(moved_->aside.string() + suffix, ignored);
    }
    moved_.reset();
}

}  // namespace trapwright::store
