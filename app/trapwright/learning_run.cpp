#include "app/trapwright/learning_run.h"

#include <fmt/format.h>

#include <chrono>
#include <mutex>

#include "app/trapwright/winner_checks.h"
#include "app/trapwright/work_display.h"

namespace trapwright::app {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// What the display's thread must know of the run.
class Situation {
 public:
    Situation(int generations, base::RunControl control)
        : generations_(generations), control_(std::move(control)) {}

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
        return fmt::format("Generation {}/{} {} {}{:.0f}/s, {}/{} individuals, {}/{} trials",
                           plan_->generation + 1, generations_, formatBar(share), left,
                           progress.trialsPerSecond, progress.individualsDone, plan_->individuals, trials,
                           plan_->trials);
    }

 private:
    mutable std::mutex mutex_;
    int generations_;
    base::RunControl control_;
    std::optional<study::GenerationPlan> plan_;
};

// Adding 0 makes the -0 of a track without overlaps a 0.
std::string describeGeneration(const study::GenerationRecord& record) {
    const trial::Fitness& best = record.statistics.best;
    const trial::Fitness& top = record.statistics.topMean;
    const evolution::StrategyValues& strategy = record.statistics.topStrategy;
    const study::IndividualRecord& winner = record.individuals[static_cast<std::size_t>(record.winner)];
    return fmt::format(
        "{:>10} {:>8.3f} {:>6.0f} {:>7.3f} {:>7.3f} {:>9} {:>9.3f} {:>6.1f} {:>7.3f} {:>7.3f} {:>7.4f} "
        "{:>7.4f} {:>7.4f} "
        "{:>7.1f}\n",
        record.index, best.total(), best.collision + 0.0, best.distance, best.orientation,
        fmt::format("{}/{}", winner.finished, winner.trials), top.total(), top.collision, top.distance,
        top.orientation, strategy.crossover, strategy.mutation, strategy.smoothing, record.seconds);
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

}  // namespace

const char* const kLearningHeading =
    "           best                                       mean of the top 30 %             geometric mean "
    "of these\n"
    "Generation        F    F_C     F_D     F_O  finished         F    F_C     F_D     F_O     p_x    p_dm   "
    "  p_s "
    "seconds\n";

Attempt<LearningReport> runLearning(store::StudyFile& file, const study::StudyInputs& inputs,
                                    const Console& console, std::optional<double> timeLimit) {
    const auto count = file.generationCount();
    if (!count) return Failure{ExitCode::badInput, count.error().message};
    std::optional<study::GenerationRecord> last;
    if (*count > 0) {
        auto loaded = file.loadGeneration(*count - 1);
        if (!loaded) return Failure{ExitCode::badInput, loaded.error().message};
        last = std::move(*loaded);
    }

    auto started = WinnerChecks::start(file, inputs);
    if (!started) return started.failure();
    WinnerChecks* const checks = started->get();

    study::LearningControl control;
    Situation situation(inputs.settings.evolution.generations, control.run);
    const Clock::time_point begin = Clock::now();
    LearningReport report;
    bool saved = true;
    bool timeOver = false;
    auto end = [&]() -> base::Result<study::LearningEnd> {
        WorkDisplay display(console, watchLearning(situation, begin, control, console));
        study::LearningEvents events;
        events.planned = [&](const study::GenerationPlan& plan) { situation.setPlan(plan); };
        events.save = [&](const study::GenerationRecord& record) -> base::Status {
            if (auto status = file.saveGeneration(record); !status) {
                saved = false;
                return status;
            }
            display.print(describeGeneration(record));
            if (checks != nullptr) {
                checks->add(record);
                if (auto status = checks->save(display); !status) {
                    saved = false;
                    return status;
                }
            }
            if (timeLimit && secondsSince(begin) + record.seconds > *timeLimit) {
                timeOver = true;
                control.stopAfterGeneration();
            }
            return base::success();
        };
        auto ended = study::evolve(inputs, std::move(last), events, control);
        if (!ended || checks == nullptr) return ended;
        if (auto status = checks->stop(display); !status) {
            saved = false;
            return status.error();
        }
        return ended;
    }();
    if (!end) return Failure{saved ? ExitCode::fault : ExitCode::cannotWrite, end.error().message};
    report.end = *end;
    report.interrupted =
        *end == study::LearningEnd::cancelled || (*end == study::LearningEnd::stopped && !timeOver);
    report.trials = control.run.done();
    report.seconds = secondsSince(begin);
    // Who asked to stop, or has a time limit, did not ask for this to begin.
    if (checks != nullptr && *end == study::LearningEnd::completed && !control.stopRequested()) {
        auto finished = checks->finish(console);
        if (!finished) return finished.failure();
        report.interrupted = !*finished;
    }
    return report;
}

}  // namespace trapwright::app
