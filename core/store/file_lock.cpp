#include "core/store/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace trapwright::store {

namespace {

std::string systemReason(int code) {
    return std::generic_category().message(code);
}

/// The process id that the holder wrote into the lock file; empty if it could not.
std::string readHolder(int descriptor) {
    std::array<char, 24> buffer{};
    const ssize_t count = ::pread(descriptor, buffer.data(), buffer.size(), 0);
    return count > 0 ? std::string(buffer.data(), static_cast<std::size_t>(count)) : std::string();
}

void writeHolder(int descriptor) {
    const std::string holder = std::to_string(::getpid());
    // Only for the other's message: a full disk must not keep a study from being opened.
    if (::ftruncate(descriptor, 0) != 0) return;
    [[maybe_unused]] const ssize_t written = ::pwrite(descriptor, holder.data(), holder.size(), 0);
}

/// Whether the path still leads to the open file: the holder before us may have removed it.
bool isStillThere(const std::filesystem::path& path, int descriptor) {
    struct stat byPath {};
    struct stat byDescriptor {};
    return ::stat(path.c_str(), &byPath) == 0 && ::fstat(descriptor, &byDescriptor) == 0 &&
           byPath.st_ino == byDescriptor.st_ino && byPath.st_dev == byDescriptor.st_dev;
}

}  // namespace

base::Result<FileLock> FileLock::acquire(const std::filesystem::path& path) {
    // One study has one lock, whatever path leads to it.
    std::error_code ignored;
    std::filesystem::path canonical = std::filesystem::weakly_canonical(path, ignored);
    if (ignored) canonical = path;
    std::filesystem::path lockPath = canonical;
    lockPath += ".lock";

    for (;;) {
        const int descriptor = ::open(lockPath.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) {
            const int code = errno;
            return base::Error{"The study " + path.string() + " cannot be written: " + lockPath.string() +
                                   " cannot be made beside it (" + systemReason(code) +
                                   "). Use a folder that you can write.",
                               base::ErrorKind::cannotWrite};
        }
        FileLock lock({}, descriptor);  // closes the descriptor on every way out
        if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            const int code = errno;
            if (code == EINTR) continue;
            if (code != EWOULDBLOCK) {
                return base::Error{"The study " + path.string() + " cannot be locked for writing (" +
                                       systemReason(code) + "). Move it to a local disk.",
                                   base::ErrorKind::cannotWrite};
            }
            const std::string holder = readHolder(descriptor);
            return base::Error{
                "The study " + path.string() + " is open for writing in another Trapwright" +
                    (holder.empty() ? "" : " (process " + holder + ")") +
                    ". Wait until that has finished or stop it; reading is possible meanwhile.",
                base::ErrorKind::busy};
        }
        if (!isStillThere(lockPath, descriptor)) continue;
        writeHolder(descriptor);
        lock.lockPath_ = std::move(lockPath);
        return lock;
    }
}

FileLock::FileLock(std::filesystem::path lockPath, int descriptor)
    : lockPath_(std::move(lockPath)), descriptor_(descriptor) {}

FileLock::FileLock(FileLock&& other) noexcept
    : lockPath_(std::move(other.lockPath_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
    if (this != &other) {
        release();
        lockPath_ = std::move(other.lockPath_);
        descriptor_ = std::exchange(other.descriptor_, -1);
    }
    return *this;
}

FileLock::~FileLock() {
    release();
}

void FileLock::release() {
    if (descriptor_ < 0) return;
    // Removed while still held, so that nobody's fresh lock is removed; an empty path means that we never
    // held it.
    if (!lockPath_.empty()) ::unlink(lockPath_.c_str());
    ::close(descriptor_);
    descriptor_ = -1;
}

}  // namespace trapwright::store
