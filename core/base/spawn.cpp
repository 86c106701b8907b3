#include "core/base/spawn.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

namespace trapwright::base {

void Descriptor::close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
}

Descriptor lift(int number, int least) {
    const Descriptor low(number);
    return Descriptor(number < 0 ? -1 : ::fcntl(number, F_DUPFD_CLOEXEC, least));
}

Error cannotStart(const std::string& program, int reason) {
    return {fmt::format("{} cannot be started: {}.", program, std::generic_category().message(reason))};
}

Result<pid_t> spawn(const std::string& program, std::vector<std::string> arguments,
                    const std::function<void(posix_spawn_file_actions_t&)>& arrange) {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> list;
    list.reserve(arguments.size() + 1);
    for (std::string& argument : arguments)
        list.push_back(argument.data());
    list.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&attributes);
    arrange(actions);
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
        ::posix_spawnp(&process, program.c_str(), &actions, &attributes, list.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) return cannotStart(program, failure);
    return process;
}

Child::~Child() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    (void)wait();
}

void Child::killGroup() const {
    if (process_ > 0) ::kill(-process_, SIGKILL);
}

int Child::wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return status;
}

}  // namespace trapwright::base
