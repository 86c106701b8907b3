#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/evaluator.h"
#include "core/study/records.h"

namespace trapwright::study {

/// How many of a winner's trials are made again at most.
inline constexpr int kCheckTrials = 100;

/// How many of the winner's trials its check makes again, in each engine; 0 if it was not simulated and there
/// is nothing to check.
int countCheckTrials(const Individual& winner);

/// Simulates a generation's winner once more on the first of its own learning trials, in the engine of the
/// inputs, which learned, and in the reference: the same starts and streams, so that their scores may be
/// compared trial by trial. Depends on the winner alone, not on when it is called or what else was checked.
/// The winner has trials. Errors: settings or part that cannot be used, genes, engines, cancelled.
base::Result<CheckRecord> checkWinner(const StudyInputs& inputs, const trial::Engine& reference,
                                      const Individual& winner, const base::RunControl& control);

/// Checks winners (checkWinner) on one thread of its own, of the lowest priority, so that learning is not
/// slowed and never waits. The latest winner comes first, because it is the one that somebody who watches
/// wants to know of. Used by one thread.
class BackgroundChecks {
 public:
    /// The engine of the inputs learned. Both engines shall use one thread.
    /// `control` pauses the work and counts its trials; stop() cancels it.
    BackgroundChecks(StudyInputs inputs, std::shared_ptr<const trial::Engine> reference,
                     base::RunControl control = {});
    BackgroundChecks(const BackgroundChecks&) = delete;
    BackgroundChecks& operator=(const BackgroundChecks&) = delete;
    ~BackgroundChecks();

    /// Has the winner checked sooner or later; it has trials.
    void add(Individual winner);
    /// What has been finished since the last call.
    std::vector<CheckRecord> takeFinished();
    /// Ends the thread; a check that is under way is dropped. What is still to be checked, earliest
    /// generation first, a check that failed included.
    std::vector<Individual> stop();

 private:
    void run();

    StudyInputs inputs_;
    std::shared_ptr<const trial::Engine> reference_;
    base::RunControl control_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<Individual> waiting_;  // the last comes first
    std::vector<Individual> left_;     // failed or dropped
    std::vector<CheckRecord> finished_;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace trapwright::study
