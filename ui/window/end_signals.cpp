#include "ui/window/end_signals.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <QSocketNotifier>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>

namespace trapwright::window {

namespace {

constexpr std::array<int, 3> kSignals = {SIGTERM, SIGINT, SIGHUP};

// A signal handler reaches nothing but globals.
std::atomic<int> wake{-1};
static_assert(std::atomic<int>::is_always_lock_free);

void noteSignal(int /*signal*/) {
    const int before = errno;
    static_cast<void>(::eventfd_write(wake, 1));
    errno = before;
}

}  // namespace

EndSignals::EndSignals(QObject* parent) : QObject(parent) {
    wake = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    auto* notifier = new QSocketNotifier(wake, QSocketNotifier::Read, this);
    connect(notifier, &QSocketNotifier::activated, this, [this] {
        eventfd_t count = 0;
        static_cast<void>(::eventfd_read(wake, &count));
        emit asked();
    });
    struct sigaction action {};
    action.sa_handler = noteSignal;
    ::sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    for (const int signal : kSignals) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        // Whoever started the program has it ignored: under nohup, or in the background of a script.
        if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
    }
}

EndSignals::~EndSignals() {
    for (const int signal : kSignals) {
        struct sigaction now {};
        ::sigaction(signal, nullptr, &now);
        if (now.sa_handler == noteSignal) (void)std::signal(signal, SIG_DFL);
    }
    ::close(wake.exchange(-1));
}

}  // namespace trapwright::window
