#include "app/trapwright/work_display.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/trapwright/exit_codes.h"

namespace trapwright::app {

namespace {

// A signal handler reaches nothing but globals.
std::atomic<int> signalCount{0};
static_assert(std::atomic<int>::is_always_lock_free);

void countSignal(int signal) {
    // It may come twice: to the launcher, which passes it on, and to all that it started.
    if (signal == SIGUSR1) {
        int none = 0;
        signalCount.compare_exchange_strong(none, 1);
        return;
    }
    const int count = signalCount.fetch_add(signal == SIGINT ? 1 : 2);
    if (count >= 2) ::_exit(static_cast<int>(ExitCode::interrupted));
}

using Clock = std::chrono::steady_clock;

constexpr auto kLook = std::chrono::milliseconds(50);  // how soon Ctrl-C is heard
constexpr auto kTerminalInterval = std::chrono::milliseconds(250);
constexpr auto kLogInterval = std::chrono::seconds(20);
constexpr int kBarWidth = 10;

/// Longer lines would wrap, and only their last row could be drawn over.
std::size_t terminalWidth() {
    constexpr std::size_t kUsual = 80;
    winsize size{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsual;
    return size.ws_col;
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
    ::sigaction(SIGUSR1, &action, &soonOverBefore_);
    // The terminal is gone; under nohup nobody minds.
    ::sigaction(SIGHUP, nullptr, &hangUpBefore_);
    if (hangUpBefore_.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
}

InterruptCounter::~InterruptCounter() {
    ::sigaction(SIGINT, &interruptBefore_, nullptr);
    ::sigaction(SIGTERM, &terminateBefore_, nullptr);
    ::sigaction(SIGUSR1, &soonOverBefore_, nullptr);
    ::sigaction(SIGHUP, &hangUpBefore_, nullptr);
}

int InterruptCounter::count() const {
    return signalCount;
}

WorkDisplay::WorkDisplay(const Console& console, WorkWatch watch)
    : console_(&console),
      watch_(std::move(watch)),
      terminal_(::isatty(STDERR_FILENO) == 1),
      thread_([this] { run(); }) {}

WorkDisplay::~WorkDisplay() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    wake_.notify_all();
    thread_.join();
    clear();
}

void WorkDisplay::print(std::string_view text) {
    const std::lock_guard lock(mutex_);
    clear();
    console_->print(text);
}

void WorkDisplay::run() {
    const Clock::duration interval =
        terminal_ ? Clock::duration(kTerminalInterval) : Clock::duration(kLogInterval);
    Clock::time_point next = Clock::now() + interval;
    int heard = 0;
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, kLook, [this] { return over_; })) {
        if (const int count = interrupts_.count(); heard < count) {
            clear();
            heard = count;
            watch_.interrupted(heard);
        }
        if (Clock::now() < next) continue;
        next = Clock::now() + interval;
        show(watch_.progress());
    }
    // A Ctrl-C of the last moment.
    if (const int count = interrupts_.count(); heard < count) watch_.interrupted(count);
}

void WorkDisplay::show(const std::string& line) {
    if (terminal_) {
        fmt::print(stderr, "\r\x1b[K{}", line.substr(0, terminalWidth() - 1));
        drawn_ = true;
    } else {
        fmt::print(stderr, "{}\n", line);
    }
    (void)std::fflush(stderr);
}

void WorkDisplay::clear() {
    if (!drawn_) return;
    fmt::print(stderr, "\r\x1b[K");
    (void)std::fflush(stderr);
    drawn_ = false;
}

WorkWatch watchTrials(const std::string& what, std::int64_t total, base::RunControl control) {
    const Clock::time_point begin = Clock::now();
    WorkWatch watch;
    watch.progress = [what, total, control, begin, before = control.done()] {
        const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        const std::int64_t done = control.done() - before;
        const double rate = static_cast<double>(done) / seconds;
        const std::string left =
            done > 0 ? formatDuration(static_cast<double>(total - done) / rate) + " left, " : "";
        const double share =
            static_cast<double>(done) / static_cast<double>(std::max<std::int64_t>(total, 1));
        return fmt::format("{} {} {}{:.0f}/s, {}/{} trials", what, formatBar(share), left, rate, done, total);
    };
    watch.interrupted = [control](int) mutable { control.cancel(); };
    return watch;
}

std::string formatBar(double share) {
    const int filled = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * kBarWidth));
    return "[" + std::string(static_cast<std::size_t>(filled), '#') +
           std::string(static_cast<std::size_t>(kBarWidth - filled), '.') + "]";
}

std::string formatDuration(double seconds) {
    const long whole = std::lround(seconds);
    if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace trapwright::app
