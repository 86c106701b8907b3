#pragma once

#include <csignal>

namespace trapwright::app {

/// While this lives, Ctrl-C (SIGINT) is counted instead of ending the process, up to the second time; a third
/// ends it at once. SIGTERM and SIGHUP count as two; SIGHUP under nohup not at all. One at a time in a
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
    struct sigaction hangUpBefore_ {};
};

}  // namespace trapwright::app
