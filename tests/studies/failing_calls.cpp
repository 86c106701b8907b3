// A library to be preloaded (LD_PRELOAD): lets calls of the system fail that write files in one folder. From
// the environment:
//   FAULTS_FOLDER   the folder, with all below it; other files are left alone
//   FAULTS_CALLS    which calls are counted, of "open write sync truncate rename" (all)
//   FAULTS_AT       the call that fails, from 1; 0: none
//   FAULTS_ERRNO    how it fails, as a number (ENOSPC)
//   FAULTS_STAYS    not empty: all from that call on fail
//   FAULTS_SHORT    not empty: a write does half of its work before it fails
//   FAULTS_REMOVE, FAULTS_REMOVE_AT   a file that is deleted at that call, counting all kinds
//   FAULTS_CLOCK    seconds that the clock of the wall is set forward at call FAULTS_AT, instead of a failure
//   FAULTS_TRACE    a file outside of the folder that gets a line for each call that is counted
#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <string>
#include <string_view>

namespace {

std::string fromEnvironment(const char* name, const char* otherwise) {
    const char* value = ::getenv(name);
    return value != nullptr ? value : otherwise;
}

long numberFromEnvironment(const char* name, long otherwise) {
    return std::strtol(fromEnvironment(name, std::to_string(otherwise).c_str()).c_str(), nullptr, 10);
}

struct Plan {
    std::string folder = fromEnvironment("FAULTS_FOLDER", "");
    std::string calls = fromEnvironment("FAULTS_CALLS", "open write sync truncate rename");
    long at = numberFromEnvironment("FAULTS_AT", 0);
    int reason = static_cast<int>(numberFromEnvironment("FAULTS_ERRNO", ENOSPC));
    bool stays = !fromEnvironment("FAULTS_STAYS", "").empty();
    bool isShort = !fromEnvironment("FAULTS_SHORT", "").empty();
    std::string remove = fromEnvironment("FAULTS_REMOVE", "");
    long removeAt = numberFromEnvironment("FAULTS_REMOVE_AT", 0);
    long clock = numberFromEnvironment("FAULTS_CLOCK", 0);
    std::string trace = fromEnvironment("FAULTS_TRACE", "");
};

const Plan& plan() {
    static const Plan thePlan;
    return thePlan;
}

std::atomic<long> seen{0};     // of all kinds
std::atomic<long> counted{0};  // of those that are counted

template <class Function>
Function* findNext(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool isInFolder(std::string_view path) {
    const std::string& folder = plan().folder;
    return !folder.empty() && path.starts_with(folder) &&
           (path.size() == folder.size() || path[folder.size()] == '/');
}

/// As it lies in the file system; a relative one is taken from the working folder.
std::string absolutePath(const char* path) {
    if (path[0] == '/') return path;
    std::string folder(PATH_MAX, '\0');
    if (::getcwd(folder.data(), folder.size()) == nullptr) return path;
    folder.resize(folder.find('\0'));
    return folder + "/" + path;
}

std::string pathOf(int descriptor) {
    std::string path(PATH_MAX, '\0');
    const ssize_t count =
        ::readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), path.data(), path.size());
    path.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return path;
}

void trace(long number, const char* call, const std::string& path) {
    if (plan().trace.empty()) return;
    using Open = int(const char*, int, ...);
    using Write = ssize_t(int, const void*, size_t);
    static auto* const nextOpen = findNext<Open>("open");
    static auto* const nextWrite = findNext<Write>("write");
    const int file = nextOpen(plan().trace.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (file < 0) return;
    const std::string line = std::to_string(number) + " " + call + " " + path + "\n";
    (void)!nextWrite(file, line.data(), line.size());
    ::close(file);
}

/// Counts a call on this file. Whether it is to fail; errno is set then.
bool failsNow(const char* call, const std::string& path) {
    const int before = errno;
    if (!isInFolder(path)) return false;
    if (++seen == plan().removeAt) ::unlink(plan().remove.c_str());
    errno = before;
    if (plan().calls.find(call) == std::string::npos) return false;
    const long number = ++counted;
    trace(number, call, path);
    errno = before;
    if (plan().at == 0 || plan().clock != 0) return false;
    if (number != plan().at && !(plan().stays && number > plan().at)) return false;
    errno = plan().reason;
    return true;
}

bool opensForWriting(int flags) {
    return (flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC)) != 0;
}

bool isClockSet() {
    return plan().clock != 0 && plan().at != 0 && counted >= plan().at;
}

/// The path that an openat() means, as far as it can matter here.
std::string pathAt(int folder, const char* path) {
    if (path[0] == '/' || folder == AT_FDCWD) return absolutePath(path);
    return pathOf(folder) + "/" + path;
}

using Open = int(const char*, int, ...);
using OpenAt = int(int, const char*, int, ...);

int openNext(const char* name, const char* path, int flags, mode_t mode) {
    if (opensForWriting(flags) && failsNow("open", absolutePath(path))) return -1;
    return findNext<Open>(name)(path, flags, mode);
}

int openNextAt(const char* name, int folder, const char* path, int flags, mode_t mode) {
    if (opensForWriting(flags) && failsNow("open", pathAt(folder, path))) return -1;
    return findNext<OpenAt>(name)(folder, path, flags, mode);
}

mode_t takeMode(int flags, va_list list) {
    return (flags & (O_CREAT | O_TMPFILE)) != 0 ? static_cast<mode_t>(va_arg(list, unsigned int)) : 0;
}

FILE* openStream(const char* name, const char* path, const char* mode) {
    if (::strpbrk(mode, "wa+") != nullptr && failsNow("open", absolutePath(path))) return nullptr;
    return findNext<FILE*(const char*, const char*)>(name)(path, mode);
}

/// Half of what is left, when the fault is to come in the middle of a write.
size_t shortened(size_t size) {
    return plan().isShort ? size / 2 : 0;
}

ssize_t writeNextAt(const char* name, int file, const void* bytes, size_t size, off_t offset) {
    using Write = ssize_t(int, const void*, size_t, off_t);
    auto* const next = findNext<Write>(name);
    if (!failsNow("write", pathOf(file))) return next(file, bytes, size, offset);
    const int reason = errno;
    const size_t part = shortened(size);
    if (part > 0) return next(file, bytes, part, offset);
    errno = reason;
    return -1;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    va_list list;
    va_start(list, flags);
    const mode_t mode = takeMode(flags, list);
    va_end(list);
    return openNext("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    va_list list;
    va_start(list, flags);
    const mode_t mode = takeMode(flags, list);
    va_end(list);
    return openNext("open64", path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
    va_list list;
    va_start(list, flags);
    const mode_t mode = takeMode(flags, list);
    va_end(list);
    return openNextAt("openat", folder, path, flags, mode);
}

int openat64(int folder, const char* path, int flags, ...) {
    va_list list;
    va_start(list, flags);
    const mode_t mode = takeMode(flags, list);
    va_end(list);
    return openNextAt("openat64", folder, path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
    return openStream("fopen", path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
    return openStream("fopen64", path, mode);
}

char* mkdtemp(char* pattern) {
    if (failsNow("open", absolutePath(pattern))) return nullptr;
    return findNext<char*(char*)>("mkdtemp")(pattern);
}

ssize_t write(int file, const void* bytes, size_t size) {
    static auto* const next = findNext<ssize_t(int, const void*, size_t)>("write");
    if (plan().folder.empty() || !failsNow("write", pathOf(file))) return next(file, bytes, size);
    const int reason = errno;
    const size_t part = shortened(size);
    if (part > 0) return next(file, bytes, part);
    errno = reason;
    return -1;
}

ssize_t writev(int file, const iovec* pieces, int count) {
    if (failsNow("write", pathOf(file))) return -1;
    return findNext<ssize_t(int, const iovec*, int)>("writev")(file, pieces, count);
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
    return writeNextAt("pwrite", file, bytes, size, offset);
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t offset) {
    return writeNextAt("pwrite64", file, bytes, size, offset);
}

int fsync(int file) {
    return failsNow("sync", pathOf(file)) ? -1 : findNext<int(int)>("fsync")(file);
}

int fdatasync(int file) {
    return failsNow("sync", pathOf(file)) ? -1 : findNext<int(int)>("fdatasync")(file);
}

int ftruncate(int file, off_t size) noexcept {
    return failsNow("truncate", pathOf(file)) ? -1 : findNext<int(int, off_t)>("ftruncate")(file, size);
}

int ftruncate64(int file, off64_t size) noexcept {
    return failsNow("truncate", pathOf(file)) ? -1 : findNext<int(int, off64_t)>("ftruncate64")(file, size);
}

int rename(const char* from, const char* to) noexcept {
    if (failsNow("rename", absolutePath(to))) return -1;
    return findNext<int(const char*, const char*)>("rename")(from, to);
}

int clock_gettime(clockid_t clock, timespec* time) noexcept {
    static auto* const next = findNext<int(clockid_t, timespec*)>("clock_gettime");
    const int result = next(clock, time);
    if (result == 0 && clock == CLOCK_REALTIME && isClockSet()) time->tv_sec += plan().clock;
    return result;
}

int gettimeofday(timeval* time, void* zone) noexcept {
    static auto* const next = findNext<int(timeval*, void*)>("gettimeofday");
    const int result = next(time, zone);
    if (result == 0 && isClockSet()) time->tv_sec += plan().clock;
    return result;
}

time_t time(time_t* result) noexcept {
    timespec now{};
    (void)clock_gettime(CLOCK_REALTIME, &now);
    if (result != nullptr) *result = now.tv_sec;
    return now.tv_sec;
}

}  // extern "C"
