#include "app/transports/pseudo_terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace trapwright::transports {

base::Status PseudoTerminal::open() {
    close();
    std::array<char, 64> name{};
    master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    const bool good = master_ >= 0 && ::grantpt(master_) == 0 && ::unlockpt(master_) == 0 &&
                      ::ptsname_r(master_, name.data(), name.size()) == 0;
    if (good) slave_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios settings{};
    if (slave_ < 0 || ::tcgetattr(slave_, &settings) != 0) {
        const std::string reason = std::generic_category().message(errno);
        close();
        return base::Error{
            fmt::format("the virtual feeder got no pseudo-terminal: {}. Is /dev/pts there, and are "
                        "not all of its terminals in use?",
                        reason)};
    }
    ::cfmakeraw(&settings);
    static_cast<void>(::tcsetattr(slave_, TCSANOW, &settings));
    name_ = name.data();
    return base::success();
}

void PseudoTerminal::close() {
    for (int* end : {&slave_, &master_}) {
        if (*end >= 0) ::close(*end);
        *end = -1;
    }
}

void PseudoTerminal::unlock() const {
    if (slave_ >= 0) static_cast<void>(::ioctl(slave_, TIOCNXCL));
}

}  // namespace trapwright::transports
