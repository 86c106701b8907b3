#include "core/base/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

#include "core/base/spawn.h"

namespace trapwright::base {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMessages = 3;      // the child's descriptor for them; its stdout is for libraries that chatter
constexpr int kOutOfMemory = 86;  // its exit code when memory is at an end
constexpr int kPatience = 50;     // [ms] between looks at the run control
constexpr char kStage = 's';      // first byte of a message
constexpr char kResult = 'r';
constexpr std::size_t kHead = 9;  // that byte and the length of the rest, 64 bits

Result<pid_t> spawnChild(const std::string& program, std::vector<std::string> arguments, int input,
                         int messages) {
    return spawn(program, std::move(arguments), [&](posix_spawn_file_actions_t& actions) {
        ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        ::posix_spawn_file_actions_adddup2(&actions, messages, kMessages);
        ::posix_spawn_file_actions_addclosefrom_np(&actions, kMessages + 1);
    });
}

bool writeAll(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

bool send(char kind, std::string_view text) {
    std::string message(kHead, kind);
    const std::uint64_t length = text.size();
    std::memcpy(message.data() + 1, &length, sizeof length);
    return writeAll(kMessages, message) && writeAll(kMessages, text);
}

/// Takes the messages that are whole out of what came; false if it is none of ours.
bool takeMessages(std::string& buffer, std::size_t most, ChildOutcome& outcome, bool& answered,
                  const std::function<void(std::string_view)>& tellStage) {
    std::size_t at = 0;
    while (buffer.size() - at >= kHead) {
        std::uint64_t length = 0;
        std::memcpy(&length, buffer.data() + at + 1, sizeof length);
        if (length > most || (buffer[at] != kStage && buffer[at] != kResult)) return false;
        if (buffer.size() - at - kHead < length) break;
        const std::string_view text = std::string_view(buffer).substr(at + kHead, length);
        if (buffer[at] == kResult) {
            outcome.result = text;
            answered = true;
        } else {
            outcome.stage = text;
            if (tellStage) tellStage(text);
        }
        at += kHead + length;
    }
    buffer.erase(0, at);
    return true;
}

enum class Hearing { toItsEnd, noSense, outOfTime, cancelled };

/// Reads until the child closes its side.
Hearing listen(int messages, const ChildLimits& limits, const RunControl& control, ChildOutcome& outcome,
               bool& answered, const std::function<void(std::string_view)>& tellStage) {
    const Clock::time_point end = Clock::now() + limits.time;
    std::string buffer;
    std::size_t heard = 0;
    std::vector<char> chunk(1U << 16U);
    while (true) {
        if (control.cancelled()) return Hearing::cancelled;
        if (Clock::now() >= end) return Hearing::outOfTime;
        pollfd ready{messages, POLLIN, 0};
        if (::poll(&ready, 1, kPatience) <= 0) continue;
        const ssize_t count = ::read(messages, chunk.data(), chunk.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return Hearing::toItsEnd;
        heard += static_cast<std::size_t>(count);
        if (heard > limits.messages) return Hearing::noSense;
        buffer.append(chunk.data(), static_cast<std::size_t>(count));
        if (!takeMessages(buffer, limits.messages, outcome, answered, tellStage)) return Hearing::noSense;
    }
}

ChildOutcome judge(ChildOutcome outcome, bool answered, int status) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory) {
        outcome.end = ChildEnd::outOfMemory;
    } else if (!answered) {
        // Also without a signal: a library that calls exit() leaves nothing to go on with.
        outcome.end = ChildEnd::crashed;
        outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }
    return outcome;
}

void limit(int resource, std::size_t most) {
    rlimit now{};
    ::getrlimit(static_cast<__rlimit_resource>(resource), &now);
    now.rlim_cur = std::min<rlim_t>(now.rlim_max, most);
    // The hard limit, too: what the libraries do cannot lift it.
    if (resource != RLIMIT_STACK) now.rlim_max = now.rlim_cur;
    ::setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

bool readNumber(const char* text, std::size_t& number) {
    const char* end = text + std::strlen(text);
    return std::from_chars(text, end, number).ptr == end;
}

}  // namespace

Result<std::filesystem::path> findOwnProgram(std::string_view name) {
    std::error_code failure;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failure);
    const std::filesystem::path installed =
        self.parent_path().parent_path() / "libexec" / "trapwright" / name;
    if (!failure && std::filesystem::exists(installed, failure)) return installed;
    const std::filesystem::path built = std::filesystem::path(TRAPWRIGHT_BUILT_PROGRAMS) / name;
    if (std::filesystem::exists(built, failure)) return built;
    return Error{
        fmt::format("The program {} is not where Trapwright needs it, at {}. Install Trapwright again.", name,
                    installed.string())};
}

Result<ChildOutcome> runChild(const std::filesystem::path& program, std::string_view request,
                              const ChildLimits& limits, const RunControl& control,
                              const std::function<void(std::string_view)>& tellStage) {
    std::array<int, 2> answers{};
    if (::pipe2(answers.data(), O_CLOEXEC) != 0) return cannotStart(program.string(), errno);
    const Descriptor hear = lift(answers[0], kMessages + 1);
    Descriptor tell = lift(answers[1], kMessages + 1);
    // A file in memory takes any request at once, a pipe only so much.
    const Descriptor input = lift(::memfd_create("request", MFD_CLOEXEC), kMessages + 1);
    if (hear.get() < 0 || tell.get() < 0 || input.get() < 0 || !writeAll(input.get(), request) ||
        ::lseek(input.get(), 0, SEEK_SET) != 0)
        return cannotStart(program.string(), errno);

    const Result<pid_t> process =
        spawnChild(program.string(),
                   {fmt::to_string(::getpid()), fmt::to_string(limits.memory), fmt::to_string(limits.stack)},
                   input.get(), tell.get());
    if (!process) return process.error();
    Child child(*process);
    tell.close();
    ChildOutcome outcome;
    bool answered = false;
    switch (listen(hear.get(), limits, control, outcome, answered, tellStage)) {
        case Hearing::cancelled:
            outcome.end = ChildEnd::cancelled;
            return outcome;
        case Hearing::outOfTime:
            outcome.end = ChildEnd::outOfTime;
            return outcome;
        case Hearing::noSense:
            outcome.end = ChildEnd::crashed;
            return outcome;
        case Hearing::toItsEnd:
            break;
    }
    return judge(std::move(outcome), answered, child.wait());
}

Result<ChildDuty> ChildDuty::begin(int count, char** arguments) {
    std::size_t parent = 0;
    std::size_t memory = 0;
    std::size_t stack = 0;
    if (count != 4 || !readNumber(arguments[1], parent) || !readNumber(arguments[2], memory) ||
        !readNumber(arguments[3], stack) || ::fcntl(kMessages, F_GETFD) < 0) {
        return Error{"This program is started by Trapwright itself. Use trapwright or trapwright-studio."};
    }
    // For what libraries open, not for what they inherit.
    ::fcntl(kMessages, F_SETFD, FD_CLOEXEC);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (static_cast<std::size_t>(::getppid()) != parent) return Error{"Who asked is gone."};
    if (!kSanitized) limit(RLIMIT_AS, memory);
    limit(RLIMIT_STACK, stack);
    limit(RLIMIT_CORE, 0);
    std::set_new_handler([] { ::_exit(kOutOfMemory); });

    ChildDuty duty;
    std::array<char, 4096> chunk{};
    ssize_t got = 0;
    while ((got = ::read(STDIN_FILENO, chunk.data(), chunk.size())) > 0)
        duty.request_.append(chunk.data(), static_cast<std::size_t>(got));
    return duty;
}

void ChildDuty::tellStage(std::string_view stage) const {
    (void)send(kStage, stage);
}

bool ChildDuty::answer(std::string_view result) const {
    return send(kResult, result);
}

}  // namespace trapwright::base
