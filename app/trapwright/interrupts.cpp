#include "app/trapwright/interrupts.h"

#include <unistd.h>

#include <atomic>

#include "app/trapwright/exit_codes.h"

namespace trapwright::app {

namespace {

// A signal handler reaches nothing but globals.
std::atomic<int> signalCount{0};
static_assert(std::atomic<int>::is_always_lock_free);

void countSignal(int signal) {
    const int count = signalCount.fetch_add(signal == SIGINT ? 1 : 2);
    if (count >= 2) ::_exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

InterruptCounter::InterruptCounter() {
    signalCount = 0;
    struct sigaction action {};
    action.sa_handler = countSignal;
    ::sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &action, &interruptBefore_);
    ::sigaction(SIGTERM, &action, &terminateBefore_);
    // The terminal is gone; under nohup nobody minds.
    ::sigaction(SIGHUP, nullptr, &hangUpBefore_);
    if (hangUpBefore_.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
}

InterruptCounter::~InterruptCounter() {
    ::sigaction(SIGINT, &interruptBefore_, nullptr);
    ::sigaction(SIGTERM, &terminateBefore_, nullptr);
    ::sigaction(SIGHUP, &hangUpBefore_, nullptr);
}

int InterruptCounter::count() const {
    return signalCount;
}

}  // namespace trapwright::app
