#pragma once

#include <chrono>
#include <mutex>

namespace trapwright::trial {

/// Where the time of simulated trials went, summed over threads.
struct Costs {
    double detection = 0.0;    // finding contacts [s]
    double law = 0.0;          // impulses, with their preparation [s]
    double integration = 0.0;  // everything else: motion, endings, starting trials [s]

    [[nodiscard]] double total() const { return detection + law + integration; }
};

/// Gathers the costs of an engine's runs, from any thread.
class CostMeter {
 public:
    void add(const Costs& costs) {
        const std::lock_guard lock(mutex_);
        sum_.detection += costs.detection;
        sum_.law += costs.law;
        sum_.integration += costs.integration;
    }

    /// All that was added so far.
    [[nodiscard]] Costs read() const {
        const std::lock_guard lock(mutex_);
        return sum_;
    }

 private:
    mutable std::mutex mutex_;
    Costs sum_;
};

/// One thread's time, told apart lap by lap by the wall clock. Without a meter a lap costs nothing but a look
/// for it; with one some 30 ns.
class CostLaps {
 public:
    /// The first lap begins now. `meter` may be null; else it is told the sum when this ends.
    explicit CostLaps(CostMeter* meter) : meter_(meter) {
        if (meter_ != nullptr) last_ = Clock::now();
    }
    CostLaps(const CostLaps&) = delete;
    CostLaps& operator=(const CostLaps&) = delete;
    ~CostLaps() {
        if (meter_ != nullptr) meter_->add(sum_);
    }

    /// What was done since the last call: end(&Costs::law).
    void end(double Costs::*what) {
        if (meter_ == nullptr) return;
        const Clock::time_point now = Clock::now();
        sum_.*what += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

 private:
    using Clock = std::chrono::steady_clock;

    CostMeter* meter_;
    Costs sum_;
    Clock::time_point last_;
};

}  // namespace trapwright::trial
