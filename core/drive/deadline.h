#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

namespace trapwright::drive {

/// Tells the time in seconds and only goes forward.
using Clock = std::function<double()>;

/// The computer's own such clock. [s]
inline double steadyTime() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A moment until which several steps together must be done.
class Deadline {
 public:
    explicit Deadline(double seconds, Clock clock = steadyTime)
        : clock_(std::move(clock)), end_(clock_() + seconds) {}

    /// What is left of it, never less than 0. [s]
    [[nodiscard]] double left() const { return std::max(end_ - clock_(), 0.0); }

 private:
    Clock clock_;
    double end_;
};

}  // namespace trapwright::drive
