#include "core/base/command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <utility>

#include "core/base/spawn.h"

namespace trapwright::base {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostOutput = 1U << 20U;

/// Reads until the other side is closed. False if that takes too long, or nobody waits any more.
bool readAll(int descriptor, Clock::time_point end, const RunControl& control, std::string& output) {
    constexpr long long kLook = 100;  // [ms]
    std::array<char, 4096> some{};
    while (true) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        if (left <= 0 || control.cancelled()) return false;
        pollfd wait{descriptor, POLLIN, 0};
        const int ready = ::poll(&wait, 1, static_cast<int>(std::min<long long>(left, kLook)));
        if (ready < 0 && errno != EINTR) return false;
        if (ready <= 0) continue;
        const ssize_t count = ::read(descriptor, some.data(), some.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return true;
        output.append(some.data(), std::min(static_cast<std::size_t>(count), kMostOutput - output.size()));
    }
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
                                  std::chrono::milliseconds limit, const RunControl& control) {
    std::array<int, 2> ends{};
    const std::string program = arguments.front();
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return cannotStart(program, errno);
    const Descriptor hear = lift(ends[0], STDERR_FILENO + 1);
    Descriptor tell = lift(ends[1], STDERR_FILENO + 1);
    arguments.erase(arguments.begin());
    const auto process = spawn(program, std::move(arguments), [&](posix_spawn_file_actions_t& actions) {
        ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_adddup2(&actions, tell.get(), STDOUT_FILENO);
        ::posix_spawn_file_actions_adddup2(&actions, tell.get(), STDERR_FILENO);
        ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
        if (!folder.empty()) ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    });
    if (!process) return process.error();
    Child child(*process);
    tell.close();
    CommandOutcome outcome;
    const bool ended = readAll(hear.get(), Clock::now() + limit, control, outcome.output);
    if (!ended) child.killGroup();
    const int status = child.wait();
    constexpr int kSignals = 128;
    outcome.code = WIFSIGNALED(status) ? kSignals + WTERMSIG(status) : WEXITSTATUS(status);
    if (!ended && control.cancelled()) return Error{program + " was not waited for and stopped."};
    if (!ended)
        return Error{fmt::format("{} did not end within {} s and was stopped.", program,
                                 std::chrono::duration_cast<std::chrono::seconds>(limit).count())};
    return outcome;
}

}  // namespace trapwright::base
