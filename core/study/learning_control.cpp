#include "core/study/learning_control.h"

#include <algorithm>

namespace trapwright::study {

void LearningControl::pause() {
    run.pause();
    checks.pause();
}

void LearningControl::resume() {
    run.resume();
    checks.resume();
}

int LearningControl::generationsOr(int fallback) const {
    const int count = generations_->load(std::memory_order_relaxed);
    return count > 0 ? count : fallback;
}

LearningProgress estimateProgress(const GenerationPlan& plan, int generations, std::int64_t done,
                                  double seconds) {
    LearningProgress progress;
    const std::int64_t here = std::clamp<std::int64_t>(done - plan.doneBefore, 0, plan.trials);
    // What is not simulated is done at once.
    progress.individualsDone = plan.individuals - plan.simulated;
    if (plan.trials > 0) progress.individualsDone += static_cast<int>(here * plan.simulated / plan.trials);
    if (done <= 0 || seconds <= 0.0) return progress;
    progress.trialsPerSecond = static_cast<double>(done) / seconds;
    const std::int64_t generationsLeft = std::max(generations - plan.generation - 1, 0);
    const std::int64_t trialsLeft = plan.trials - here + generationsLeft * plan.trials;
    progress.secondsLeft = static_cast<double>(trialsLeft) / progress.trialsPerSecond;
    return progress;
}

}  // namespace trapwright::study
