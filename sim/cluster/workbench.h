#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "core/base/run_control.h"
#include "core/trial/engine_registry.h"
#include "sim/cluster/messages.h"

namespace trapwright::cluster {

/// A task with all that it needs.
struct Job {
    std::uint64_t task = 0;
    std::uint64_t run = 0;
    std::string engine;
    unsigned threads = 0;  // 0: those of the workbench
    double step = 0.0;     // trial::EngineOptions::step [s]
    bool isAside = false;
    std::vector<trial::TrialBatch> batches;
};

struct FinishedJob {
    std::uint64_t task = 0;
    std::string problem;  // why there are no outcomes; empty: there are
    std::vector<trial::Outcome> outcomes;
    double seconds = 0.0;
};

/// Where one rank simulates: two threads that each make one job after the other, one of them at the lowest
/// priority. Safe to call from several threads.
class Workbench {
 public:
    Workbench(trial::EngineRegistry engines, unsigned threads);
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;
    /// Cancels what is not finished.
    ~Workbench();

    void add(Job job);
    /// Those that ended since the last call, also by being cancelled.
    std::vector<FinishedJob> takeFinished();
    /// Of all jobs that are not finished.
    [[nodiscard]] std::vector<Progress> progress() const;
    void steer(std::uint64_t run, RunState state);

 private:
    struct Waiting {
        Job job;
        base::RunControl control;
    };
    struct Active {
        std::uint64_t task = 0;
        std::uint64_t run = 0;
        base::RunControl control;
    };
    struct Lane {
        std::deque<Waiting> waiting;
        std::jthread thread;
    };

    void work(Lane& lane, bool isAside);
    FinishedJob perform(const Waiting& waiting);

    trial::EngineRegistry engines_;
    unsigned threads_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    bool over_ = false;
    std::vector<Active> active_;
    std::vector<FinishedJob> finished_;
    std::array<Lane, 2> lanes_;  // last: their threads use all of the above
};

}  // namespace trapwright::cluster
