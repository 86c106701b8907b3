#include "app/trapwright/learning_run.h"

#include <fmt/format.h>

#include <chrono>
#include <mutex>

#include "app/trapwright/work_display.h"
#include "app/trapwright/work_failure.h"
#include "core/stats/binomial.h"
#include "core/workflow/learning.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPercent = 100.0;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// What the display's thread must know of the run.
class Situation {
 public:
    Situation(int generations, base::RunControl control)
        : generations_(generations), control_(std::move(control)) {}

    void setSuccess(const std::optional<stats::Count>& success) {
        const std::lock_guard lock(mutex_);
        success_ = success;
    }

    void setPlan(const study::GenerationPlan& plan) {
        const std::lock_guard lock(mutex_);
        plan_ = plan;
    }

    [[nodiscard]] std::string describe(Clock::time_point begin) const {
        const std::lock_guard lock(mutex_);
        if (!plan_) return "Building the tracks of the first generation";
        const study::LearningProgress progress =
            study::estimateProgress(*plan_, generations_, control_.done(), secondsSince(begin));
        const std::int64_t trials = control_.done() - plan_->doneBefore;
        const double share =
            plan_->trials > 0 ? static_cast<double>(trials) / static_cast<double>(plan_->trials) : 1.0;
        // What matters least is last, where a narrow terminal cuts.
        const std::string left =
            progress.secondsLeft > 0.0 ? formatDuration(progress.secondsLeft) + " left, " : "";
        const std::string success =
            success_ ? fmt::format("success {:.1f} %, ", kPercent * success_->share()) : "";
        return fmt::format("Generation {}/{} {} {}{}{:.0f}/s, {}/{} individuals, {}/{} trials",
                           plan_->generation + 1, generations_, formatBar(share), success, left,
                           progress.trialsPerSecond, progress.individualsDone, plan_->individuals, trials,
                           plan_->trials);
    }

 private:
    mutable std::mutex mutex_;
    int generations_;
    base::RunControl control_;
    std::optional<study::GenerationPlan> plan_;
    std::optional<stats::Count> success_;  // of the newest winner
};

/// "85.0   62.1 ... 96.8", in percent.
std::string describeSuccess(const std::optional<stats::Count>& success) {
    if (!success) return fmt::format("{:>7}   {:>15}", "-", "-");
    const stats::Interval bounds = stats::calcClopperPearson(success->successes, success->trials);
    return fmt::format("{:>7.1f}   {:>5.1f} ... {:>5.1f}", kPercent * success->share(), kPercent * bounds.low,
                       kPercent * bounds.high);
}

/// Of the column of one of the search's curves.
std::size_t widthOf(const search::NumberInfo& curve) {
    constexpr std::size_t kLeast = 7;
    return std::max(kLeast, curve.key.size());
}

// Adding 0 makes the -0 of a track without overlaps a 0.
std::string describeGeneration(search::Method method, const study::GenerationRecord& record) {
    const trial::Fitness& best = record.statistics.best;
    const trial::Fitness& top = record.statistics.topMean;
    std::string curves;
    for (const search::NumberInfo& info : search::describeMethod(method).curves) {
        const auto value = search::findNumber(record.statistics.curves, info.key);
        curves += fmt::format(" {:>{}}", value ? fmt::format("{:.{}f}", *value, info.decimals) : "-",
                              widthOf(info));
    }
    const study::IndividualRecord& winner = record.individuals[static_cast<std::size_t>(record.winner)];
    const std::optional<double>& topSuccess = record.statistics.topSuccess;
    return fmt::format(
        "{:>10} {} {:>9} {:>8.3f} {:>6.0f} {:>7.3f} {:>7.3f} {:>8} {:>8.3f} {:>6.1f} {:>7.3f} {:>7.3f}{} "
        "{:>7.1f}\n",
        record.index, describeSuccess(record.statistics.success),
        fmt::format("{}/{}", winner.finished, winner.trials), best.total(), best.collision + 0.0,
        best.distance, best.orientation, topSuccess ? fmt::format("{:.1f}", kPercent * *topSuccess) : "-",
        top.total(), top.collision, top.distance, top.orientation, curves, record.seconds);
}

/// The reference's scores below those of the generation's line, and how they differ from the learning
/// engine's on the same trials. Adding 0 makes a -0 a 0.
std::string describeCheck(const study::CheckRecord& record) {
    const study::EngineScore& reference = record.reference;
    const study::EngineScore& learning = record.learning;
    return fmt::format(
        "{:>10} {} {:>9} {:>8.3f} {:>6.0f} {:>7.3f} {:>7.3f}   {} less {}: success {:.0f} % less {:.0f} %, "
        "F_D {:+.3f}, F_O {:+.3f}\n",
        fmt::format("check {}", record.generation),
        describeSuccess(stats::Count{reference.oriented, record.trials}),
        fmt::format("{}/{}", reference.finished, record.trials), reference.fitness.total(),
        reference.fitness.collision + 0.0, reference.fitness.distance, reference.fitness.orientation,
        reference.engine, learning.engine, kPercent * reference.oriented / record.trials,
        kPercent * learning.oriented / record.trials, reference.fitness.distance - learning.fitness.distance,
        reference.fitness.orientation - learning.fitness.orientation);
}

WorkWatch watchLearning(const Situation& situation, Clock::time_point begin, study::LearningControl control,
                        const Console& console) {
    WorkWatch watch;
    watch.progress = [&situation, begin] { return situation.describe(begin); };
    watch.interrupted = [control, &console](int count) mutable {
        if (count == 1) {
            control.stopAfterGeneration();
            console.note("Stopping after this generation. Ctrl-C once more drops it and stops at once.");
        } else {
            control.run.cancel();
        }
    };
    return watch;
}

/// Makes the checks that are left and shows the progress. False if Ctrl-C ended it; the rest stays to be
/// done.
Attempt<bool> finishChecks(store::StudyFile& file, const study::StudyInputs& inputs,
                           const std::vector<study::Individual>& left, const Console& console) {
    if (left.empty()) return true;
    const base::RunControl control;
    WorkDisplay display(console, watchTrials("Checking winners", workflow::countCheckTrials(left), control));
    const auto checked = workflow::checkWinners(
        file, inputs, engines::registry(), left,
        [&](const study::CheckRecord& record) { display.print(describeCheck(record)); }, control);
    if (checked) return true;
    if (checked.error().kind == workflow::FailureKind::cancelled) return false;
    return toFailure(checked.error(), file);
}

}  // namespace

std::string learningHeading(search::Method method) {
    std::string names;
    for (const search::NumberInfo& curve : search::describeMethod(method).curves)
        names += fmt::format(" {:>{}}", curve.key, widthOf(curve));
    return fmt::format(
        "               [%]          95 % [%]  the generation's winner                       [%]    m"
        "ean of the top 30 %           {:^{}}\n"
        "Generation success   Clopper-Pearson  finished        F    F_C     F_D     F_O  success     "
        "   F    F_C     F_D     F_O{} seconds\n",
        "the search", names.size(), names);
}

Attempt<LearningRun> runLearning(store::StudyFile& file, const study::StudyInputs& inputs,
                                 const Console& console, std::optional<double> timeLimit) {
    study::LearningControl control;
    Situation situation(inputs.settings.evolution.generations, control.run);
    const Clock::time_point begin = Clock::now();
    bool timeOver = false;
    auto learned = [&] {
        WorkDisplay display(console, watchLearning(situation, begin, control, console));
        workflow::LearnEvents events;
        events.planned = [&](const study::GenerationPlan& plan) { situation.setPlan(plan); };
        events.saved = [&](const study::GenerationRecord& record) {
            situation.setSuccess(record.statistics.success);
            display.print(describeGeneration(inputs.settings.evolution.search, record));
            if (timeLimit && secondsSince(begin) + record.seconds > *timeLimit) {
                timeOver = true;
                control.stopAfterGeneration();
            }
        };
        events.checked = [&](const study::CheckRecord& record) { display.print(describeCheck(record)); };
        return workflow::learn(file, inputs, engines::registry(), events, control);
    }();
    if (!learned) return toFailure(learned.error(), file);
    LearningRun ran{std::move(*learned), false};
    const study::LearningEnd end = ran.report.end;
    ran.interrupted =
        end == study::LearningEnd::cancelled || (end == study::LearningEnd::stopped && !timeOver);
    // Who asked to stop, or has a time limit, did not ask for this to begin.
    if (end == study::LearningEnd::completed && !control.stopRequested()) {
        auto finished = finishChecks(file, inputs, ran.report.unchecked, console);
        if (!finished) return finished.failure();
        ran.interrupted = !*finished;
    }
    if (const auto there = file.checkInPlace(); !there)
        return toFailure({workflow::FailureKind::saving, there.error().message}, file);
    return ran;
}

}  // namespace trapwright::app
