#include "core/store/open_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

namespace trapwright::store {

namespace {

using Identity = std::array<std::uint64_t, 2>;

// Past all that SQLite reads, writes or locks: its files have at most 2^48 bytes.
constexpr off_t kLockedByte = 1LL << 60;

struct Inode {
    std::vector<int> descriptors;  // never empty; closed together
    int users = 0;
    int writable = -1;  // the one of them that can be locked; negative: none yet
    bool locked = false;
};

/// All files that OpenFiles have open. One for the process, as its locks are.
struct Registry {
    std::mutex mutex;
    std::map<Identity, Inode> inodes;
};

Registry& registry() {
    static Registry theOne;
    return theOne;
}

Identity identityOf(const struct stat& status) {
    return {static_cast<std::uint64_t>(status.st_dev), static_cast<std::uint64_t>(status.st_ino)};
}

std::string systemReason(int code) {
    return std::generic_category().message(code);
}

base::Error unreadable(const std::filesystem::path& path, int code) {
    return base::Error{"The study " + path.string() + " cannot be read (" + systemReason(code) +
                       "). Check its permissions."};
}

/// Of the whole description, so that it neither goes with another descriptor nor hides from this process.
int setLock(int descriptor, short kind) {
    struct flock lock {};
    lock.l_type = kind;
    lock.l_whence = SEEK_SET;
    lock.l_start = kLockedByte;
    lock.l_len = 1;
    return ::fcntl(descriptor, F_OFD_SETLK, &lock);
}

/// Opens the file once more so that it can be locked.
base::Status addWritable(const std::filesystem::path& path, Inode& inode) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) {
        return base::Error{"The study " + path.string() + " cannot be written (" + systemReason(errno) +
                               "). Change its permissions, or copy it into a folder that you can write.",
                           base::ErrorKind::cannotWrite};
    }
    struct stat status {};
    (void)::fstat(descriptor, &status);
    auto& inodes = registry().inodes;
    const auto opened = inodes.find(identityOf(status));
    if (opened == inodes.end() || &opened->second != &inode) {
        if (opened == inodes.end()) {
            ::close(descriptor);
        } else {
            opened->second.descriptors.push_back(descriptor);
        }
        return base::Error{"The study " + path.string() +
                           " was replaced by another file while it was opened. Open it again."};
    }
    inode.descriptors.push_back(descriptor);
    inode.writable = descriptor;
    return base::success();
}

}  // namespace

base::Result<OpenFile> OpenFile::open(const std::filesystem::path& path) {
    struct stat status {};
    const std::lock_guard guard(registry().mutex);
    if (::stat(path.c_str(), &status) != 0) {
        if (errno != ENOENT && errno != ENOTDIR) return unreadable(path, errno);
        return base::Error{"There is no study at " + path.string() +
                           ". Check the path, or make a new study."};
    }
    if (S_ISDIR(status.st_mode))
        return base::Error{path.string() + " is a folder, not a study. Choose a .trap file."};
    if (!S_ISREG(status.st_mode))
        return base::Error{path.string() +
                           " is no ordinary file, so it is not a study. Choose a .trap file."};
    auto& inodes = registry().inodes;
    if (const auto known = inodes.find(identityOf(status)); known != inodes.end()) {
        ++known->second.users;
        return OpenFile(path, known->first, known->second.descriptors.front());
    }
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return unreadable(path, errno);
    // Another file may have taken the name since; that one may be known.
    (void)::fstat(descriptor, &status);
    const Identity identity = identityOf(status);
    Inode& inode = inodes[identity];
    inode.descriptors.push_back(descriptor);
    ++inode.users;
    return OpenFile(path, identity, descriptor);
}

base::Status OpenFile::lockForWriting() {
    const std::lock_guard guard(registry().mutex);
    Inode& inode = registry().inodes.at(identity_);
    const auto refuse = [&] {
        return base::Error{"The study " + path_.string() +
                               " is open for writing in another Trapwright, under another name. Wait until "
                               "that has finished or stop it; reading is possible meanwhile.",
                           base::ErrorKind::busy};
    };
    if (inode.locked) return refuse();
    if (inode.writable < 0) {
        if (auto opened = addWritable(path_, inode); !opened) return opened;
    }
    if (setLock(inode.writable, F_WRLCK) != 0) {
        if (errno == EAGAIN || errno == EACCES) return refuse();
        return base::Error{"The study " + path_.string() + " cannot be locked for writing (" +
                               systemReason(errno) + "). Move it to a local disk.",
                           base::ErrorKind::cannotWrite};
    }
    inode.locked = true;
    locked_ = true;
    return base::success();
}

std::string OpenFile::readBeginning(std::size_t count) const {
    std::string bytes(count, '\0');
    const ssize_t got = ::pread(descriptor_, bytes.data(), count, 0);
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
}

std::uintmax_t OpenFile::size() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::uintmax_t>(status.st_size) : 0;
}

std::uintmax_t OpenFile::countNames() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::uintmax_t>(status.st_nlink) : 0;
}

OpenFile::OpenFile(std::filesystem::path path, const Identity& identity, int descriptor)
    : path_(std::move(path)), identity_(identity), descriptor_(descriptor) {}

OpenFile::OpenFile(OpenFile&& other) noexcept
    : path_(std::move(other.path_)),
      identity_(other.identity_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      locked_(std::exchange(other.locked_, false)) {}

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
    if (this != &other) {
        release();
        path_ = std::move(other.path_);
        identity_ = other.identity_;
        descriptor_ = std::exchange(other.descriptor_, -1);
        locked_ = std::exchange(other.locked_, false);
    }
    return *this;
}

OpenFile::~OpenFile() {
    release();
}

void OpenFile::release() {
    if (descriptor_ < 0) return;
    const std::lock_guard guard(registry().mutex);
    const auto place = registry().inodes.find(identity_);
    Inode& inode = place->second;
    if (locked_) {
        (void)setLock(inode.writable, F_UNLCK);
        inode.locked = false;
    }
    if (--inode.users == 0) {
        for (const int descriptor : inode.descriptors)
            ::close(descriptor);
        registry().inodes.erase(place);
    }
    descriptor_ = -1;
}

}  // namespace trapwright::store
