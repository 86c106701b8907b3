#include "core/study/background_checks.h"

#include <algorithm>
#include <utility>

#include "core/base/thread_priority.h"
#include "core/study/reference_check.h"

namespace trapwright::study {

BackgroundChecks::BackgroundChecks(StudyInputs inputs, std::shared_ptr<const trial::Engine> reference,
                                   base::RunControl control)
    : inputs_(std::move(inputs)),
      reference_(std::move(reference)),
      control_(std::move(control)),
      thread_([this] { run(); }) {}

BackgroundChecks::~BackgroundChecks() {
    stop();
}

void BackgroundChecks::add(Individual winner) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(winner));
    }
    wake_.notify_one();
}

std::vector<CheckRecord> BackgroundChecks::takeFinished() {
    const std::lock_guard lock(mutex_);
    return std::exchange(finished_, {});
}

std::vector<Individual> BackgroundChecks::stop() {
    {
        // Under the lock, or the thread could miss it between its look and its wait.
        const std::lock_guard lock(mutex_);
        control_.cancel();
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
    std::vector<Individual> left = std::exchange(left_, {});
    for (Individual& winner : std::exchange(waiting_, {}))
        left.push_back(std::move(winner));
    std::sort(left.begin(), left.end(),
              [](const Individual& a, const Individual& b) { return a.generation < b.generation; });
    return left;
}

void BackgroundChecks::run() {
    base::lowerPriority();
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return control_.cancelled() || !waiting_.empty(); });
        if (control_.cancelled()) return;
        Individual winner = std::move(waiting_.back());
        waiting_.pop_back();
        lock.unlock();
        auto record = checkWinner(inputs_, *reference_, winner, control_);
        lock.lock();
        // An engine that fails will fail again where somebody hears of it: see stop().
        if (record) {
            finished_.push_back(std::move(*record));
        } else {
            left_.push_back(std::move(winner));
        }
    }
}

}  // namespace trapwright::study
