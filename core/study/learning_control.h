#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "core/base/run_control.h"

namespace trapwright::study {

/// What one generation is going to cost, known once its tracks are built; of a race an estimate, made anew
/// for each round.
struct GenerationPlan {
    int generation = 0;
    int individuals = 0;          // the population
    int simulated = 0;            // of them; the others' surfaces overlap themselves
    std::int64_t trials = 0;      // of all together
    std::int64_t doneBefore = 0;  // RunControl::done() before its first trial
};

/// A copyable handle on a learning run: any copy may stop it, from any thread and from a signal handler.
class LearningControl {
 public:
    /// Ends the run as soon as the engine can stop; the unfinished generation is dropped. Counts the trials.
    base::RunControl run;
    /// Of what goes on beside the run: checks of winners. Counts their trials.
    base::RunControl checks;

    /// Has run and checks stand still.
    void pause();
    void resume();

    /// Ends the run when the present generation is saved.
    void stopAfterGeneration() { stop_->store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool stopRequested() const { return stop_->load(std::memory_order_relaxed); }

    /// Has the run end after this many generations in all, whatever its settings say.
    void setGenerations(int count) { generations_->store(count, std::memory_order_relaxed); }
    /// That number, or `fallback` where none was set.
    [[nodiscard]] int generationsOr(int fallback) const;

 private:
    std::shared_ptr<std::atomic<bool>> stop_ = std::make_shared<std::atomic<bool>>(false);
    std::shared_ptr<std::atomic<int>> generations_ = std::make_shared<std::atomic<int>>(0);
};

/// How far a learning run has come.
struct LearningProgress {
    int individualsDone = 0;       // of the present generation
    double trialsPerSecond = 0.0;  // since the run began
    double secondsLeft =
        0.0;  // until the last generation, if the others cost as much as this; 0 while unknown
};

/// `done`: trials since the run began (RunControl::done() less its value then); `seconds`: time since then.
LearningProgress estimateProgress(const GenerationPlan& plan, int generations, std::int64_t done,
                                  double seconds);

}  // namespace trapwright::study
