#include "core/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace trapwright::base {

namespace {

// An open file descriptor that does not outlive its scope.
class Descriptor {
 public:
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    [[nodiscard]] int get() const { return descriptor_; }
    // Closes now, because on some file systems only that tells of a full disk.
    bool close() {
        const int descriptor = descriptor_;
        descriptor_ = -1;
        return ::close(descriptor) == 0;
    }

 private:
    int descriptor_;
};

Error makeError(const char* action, const std::filesystem::path& path, int reason) {
    return {std::string("Cannot ") + action + " " + path.string() + ": " +
            std::generic_category().message(reason) + "."};
}

bool writeAll(int descriptor, std::string_view content) {
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

}  // namespace

Result<std::string> readFile(const std::filesystem::path& path, std::size_t mostBytes) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) return makeError("open", path, errno);
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) return makeError("open", path, errno);
    // Some devices never end. A pipe does: `--settings <(...)`.
    if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode))
        return Error{"Cannot read " + path.string() + ": it is a device. Choose a file."};
    std::string content;
    std::array<char, 65536> buffer{};
    for (;;) {
        const ssize_t count = ::read(file.get(), buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return makeError("read", path, errno);
        if (count == 0) return content;
        content.append(buffer.data(), static_cast<std::size_t>(count));
        if (content.size() > mostBytes) {
            return Error{"Cannot read " + path.string() + ": it is longer than " +
                         std::to_string(mostBytes >> 20U) + " MiB. Choose another file."};
        }
    }
}

Status writeFile(const std::filesystem::path& path, std::string_view content) {
    // Beside the target, so that the rename stays within one file system; under a name that nobody else
    // writes.
    std::string beside;
    int descriptor = -1;
    for (int attempt = 0; descriptor < 0 && attempt < 100; ++attempt) {
        beside = path.string() + "." + std::to_string(::getpid()) + "-" + std::to_string(attempt);
        descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno != EEXIST) break;
    }
    Descriptor file(descriptor);
    if (file.get() < 0) return makeError("write", path, errno);
    const bool written = writeAll(file.get(), content) && ::fsync(file.get()) == 0 && file.close() &&
                         ::rename(beside.c_str(), path.c_str()) == 0;
    if (!written) {
        const int reason = errno;
        ::unlink(beside.c_str());
        return makeError("write", path, reason);
    }
    syncFolder(std::filesystem::absolute(path).parent_path());
    return success();
}

void syncFolder(const std::filesystem::path& folder) {
    const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened.get() >= 0) ::fsync(opened.get());
}

}  // namespace trapwright::base
