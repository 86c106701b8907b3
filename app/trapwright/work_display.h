#pragma once

#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "app/trapwright/console.h"
#include "core/base/run_control.h"

namespace trapwright::app {

/// While this lives, Ctrl-C (SIGINT) is counted instead of ending the process, up to the second time; a third
/// ends it at once. SIGTERM and SIGHUP count as two; SIGHUP under nohup not at all. SIGUSR1, which batch
/// systems send some time before they end a job, is a first one, however often it comes. One at a time in a
/// process.
class InterruptCounter {
 public:
    InterruptCounter();
    InterruptCounter(const InterruptCounter&) = delete;
    InterruptCounter& operator=(const InterruptCounter&) = delete;
    ~InterruptCounter();

    /// How often so far, since this was made.
    [[nodiscard]] int count() const;

 private:
    struct sigaction interruptBefore_ {};
    struct sigaction terminateBefore_ {};
    struct sigaction soonOverBefore_ {};
    struct sigaction hangUpBefore_ {};
};

/// What a WorkDisplay asks and tells. Called on its own thread.
struct WorkWatch {
    std::function<std::string()> progress;       // how far the work is, one line
    std::function<void(int count)> interrupted;  // Ctrl-C came so often; of two at once the second
};

/// Looks after a piece of long work while it lives: shows how far it is, on stderr, as a line that is drawn
/// over if that is a terminal and otherwise as a line now and then; and hears Ctrl-C.
class WorkDisplay {
 public:
    WorkDisplay(const Console& console, WorkWatch watch);
    WorkDisplay(const WorkDisplay&) = delete;
    WorkDisplay& operator=(const WorkDisplay&) = delete;
    ~WorkDisplay();

    /// Prints a result on stdout without tearing the progress line.
    void print(std::string_view text);

 private:
    void run();
    void show(const std::string& line);
    void clear();

    const Console* console_;
    WorkWatch watch_;
    InterruptCounter interrupts_;
    bool terminal_;
    bool drawn_ = false;
    bool over_ = false;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread thread_;  // last: it uses all of the above
};

/// The watch on `total` trials: a bar, n of N, trials per second and time left; Ctrl-C cancels at once.
WorkWatch watchTrials(const std::string& what, std::int64_t total, base::RunControl control);

/// "[###.......]" for 0.3.
std::string formatBar(double share);
/// "0:35", "1:02:35".
std::string formatDuration(double seconds);

}  // namespace trapwright::app
