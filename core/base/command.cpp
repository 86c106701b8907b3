#include "core/base/command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace trapwright::base {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostOutput = 1U << 20U;

class Descriptor {
 public:
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }

    [[nodiscard]] int get() const { return descriptor_; }
    void close() {
        if (descriptor_ >= 0) ::close(descriptor_);
        descriptor_ = -1;
    }

 private:
    int descriptor_;
};

Error cannotStart(const std::string& program, int code) {
    return {fmt::format("{} cannot be started ({}).", program, std::generic_category().message(code))};
}

/// In a group of its own, so that Ctrl-C is ours to answer; signals as in a new program.
Result<pid_t> spawn(std::vector<std::string>& arguments, const std::string& folder, int output) {
    std::vector<char*> list;
    list.reserve(arguments.size() + 1);
    for (std::string& argument : arguments)
        list.push_back(argument.data());
    list.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    if (!folder.empty()) ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    sigset_t none;
    sigset_t all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setflags(&attributes,
                               POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    pid_t process = 0;
    const int failure =
        ::posix_spawnp(&process, arguments.front().c_str(), &actions, &attributes, list.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) return cannotStart(arguments.front(), failure);
    return process;
}

/// Reads until the other side is closed. False if that takes too long.
bool readAll(int descriptor, Clock::time_point end, std::string& output) {
    std::array<char, 4096> some{};
    while (true) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        if (left <= 0) return false;
        pollfd wait{descriptor, POLLIN, 0};
        const int ready = ::poll(&wait, 1, static_cast<int>(std::min<long long>(left, 1000)));
        if (ready < 0 && errno != EINTR) return false;
        if (ready <= 0) continue;
        const ssize_t count = ::read(descriptor, some.data(), some.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return true;
        output.append(some.data(), std::min(static_cast<std::size_t>(count), kMostOutput - output.size()));
    }
}

int waitFor(pid_t process) {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    constexpr int kSignals = 128;
    return WIFSIGNALED(status) ? kSignals + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

bool hasCommand(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
        if (!folder.empty() && ::access((std::filesystem::path(folder) / name).c_str(), X_OK) == 0)
            return true;
    return false;
}

Result<CommandOutcome> runCommand(std::vector<std::string> arguments, const std::string& folder,
                                  std::chrono::milliseconds limit) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return cannotStart(arguments.front(), errno);
    const Descriptor hear(ends[0]);
    Descriptor tell(ends[1]);
    const auto process = spawn(arguments, folder, tell.get());
    if (!process) return process.error();
    tell.close();
    CommandOutcome outcome;
    const bool ended = readAll(hear.get(), Clock::now() + limit, outcome.output);
    if (!ended) ::kill(-*process, SIGKILL);
    outcome.code = waitFor(*process);
    if (!ended)
        return Error{fmt::format("{} did not end within {} s and was stopped.", arguments.front(),
                                 std::chrono::duration_cast<std::chrono::seconds>(limit).count())};
    return outcome;
}

}  // namespace trapwright::base
