#include "app/trapwright/learning_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <string_view>

#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/stats/binomial.h"
#include "core/study/selection.h"
#include "core/study/track_design.h"
#include "core/workflow/learning.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPercent = 100.0;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// What is told of winners: where parts that fall off come again, how many of those that finish are right.
std::string_view successName(const study::EvolutionSettings& settings) {
    return study::forgivesFalls(settings) ? "correct" : "success";
}
std::optional<stats::Count> successOf(const study::EvolutionSettings& settings,
                                      const study::GenerationRecord& record) {
    if (!study::forgivesFalls(settings)) return record.statistics.success;
    return record.individuals[static_cast<std::size_t>(record.winner)].correct();
}

/// What the display's thread must know of the run.
class Situation {
 public:
    Situation(const study::EvolutionSettings& settings, base::RunControl control)
        : generations_(settings.generations),
          successName_(successName(settings)),
          control_(std::move(control)) {}

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
            success_ ? fmt::format("{} {:.1f} %, ", successName_, kPercent * success_->share()) : "";
        if (plan_->planningFor > 0)
            return fmt::format("Planning {} {}{:.0f}/s, {}/{} trials", formatBar(share), left,
                               progress.trialsPerSecond, trials, plan_->trials);
        return fmt::format("Generation {}/{} {} {}{}{:.0f}/s, {}/{} individuals, {}/{} trials",
                           plan_->generation + 1, generations_, formatBar(share), success, left,
                           progress.trialsPerSecond, progress.individualsDone, plan_->individuals, trials,
                           plan_->trials);
    }

 private:
    mutable std::mutex mutex_;
    int generations_;
    std::string_view successName_;
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

std::size_t widthOf(const objectives::Objective& objective) {
    const std::size_t least = objective.decimals == 0 ? 6 : 7;
    return std::max(least, objective.symbol.size());
}

/// A column each.
std::string scoresText(const objectives::Fitness& fitness, const objectives::ObjectiveList& objectives,
                       int leastDecimals = 0) {
    std::string text;
    for (const objectives::Objective* objective : objectives) {
        const objectives::Score* score = objectives::findScore(fitness, objective->key);
        text += fmt::format(
            " {:>{}}", score != nullptr ? objectives::shown(*objective, score->value, leastDecimals) : "-",
            widthOf(*objective));
    }
    return text;
}

std::string describeGeneration(const study::EvolutionSettings& settings,
                               const study::GenerationRecord& record) {
    const objectives::ObjectiveList summed = study::summedObjectives(settings);
    const objectives::Fitness& best = record.statistics.best;
    const objectives::Fitness& top = record.statistics.topMean;
    std::string curves;
    for (const search::NumberInfo& info : study::describeSearch(settings).curves) {
        const auto value = search::findNumber(record.statistics.curves, info.key);
        curves += fmt::format(" {:>{}}", value ? fmt::format("{:.{}f}", *value, info.decimals) : "-",
                              widthOf(info));
    }
    const study::IndividualRecord& winner = record.individuals[static_cast<std::size_t>(record.winner)];
    const std::optional<double>& topSuccess = record.statistics.topSuccess;
    return fmt::format("{:>10} {} {:>9} {:>8.3f}{} {:>8} {:>8.3f}{}{} {:>7.1f}\n", record.index,
                       describeSuccess(successOf(settings, record)),
                       fmt::format("{}/{}", winner.finished, winner.trials), best.total,
                       scoresText(best, summed),
                       topSuccess ? fmt::format("{:.1f}", kPercent * *topSuccess) : "-", top.total,
                       scoresText(top, summed, 1), curves, record.seconds);
}

/// The reference's scores below those of the generation's line, and how they differ from the learning
/// engine's on the same trials.
std::string describeCheck(const study::EvolutionSettings& settings, const study::CheckRecord& record) {
    const objectives::ObjectiveList summed = study::summedObjectives(settings);
    const study::EngineScore& reference = record.reference;
    const study::EngineScore& learning = record.learning;
    const bool forgives = study::forgivesFalls(settings);
    const auto count = [&](const study::EngineScore& score) {
        return stats::Count{score.oriented, std::max(1, forgives ? score.finished : record.trials)};
    };
    std::string text = fmt::format(
        "{:>10} {} {:>9} {:>8.3f}{}   {} less {}: {} {:.0f} % less {:.0f} %",
        fmt::format("check {}", record.generation), describeSuccess(count(reference)),
        fmt::format("{}/{}", reference.finished, record.trials), reference.fitness.total,
        scoresText(reference.fitness, summed), reference.engine, learning.engine, successName(settings),
        kPercent * count(reference).share(), kPercent * count(learning).share());
    for (const objectives::Objective* objective : summed) {
        const objectives::Score* judged = objectives::findScore(reference.fitness, objective->key);
        const objectives::Score* own = objectives::findScore(learning.fitness, objective->key);
        if (!objective->isNoisy || objective->isSuccess || judged == nullptr || own == nullptr) continue;
        text += fmt::format(", {} {:+.{}f}", objective->symbol,
                            (judged->value - own->value) * objective->shownAs, objective->decimals);
    }
    return text + "\n";
}

std::string describeUnturned(double wanted) {
    return fmt::format(
        "{:.1f} % of the parts come to the traps as they are wanted; the others are to be turned, or thrown "
        "out.\n",
        kPercent * wanted);
}

WorkWatch watchLearning(const Situation& situation, Clock::time_point begin, study::LearningControl control,
                        const Console& console) {
    WorkWatch watch;
    watch.progress = [&situation, begin] { return situation.describe(begin); };
    watch.interrupted = [control, &console](int count) mutable {
        control.stopAfterGeneration();
        if (count == 1) {
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
        [&](const study::CheckRecord& record) {
            display.print(describeCheck(inputs.settings.evolution, record));
        },
        control);
    if (checked) return true;
    if (checked.error().kind == workflow::FailureKind::cancelled) return false;
    return toFailure(checked.error(), file);
}

}  // namespace

std::string learningHeading(const study::EvolutionSettings& settings) {
    std::string curves;
    for (const search::NumberInfo& curve : study::describeSearch(settings).curves)
        curves += fmt::format(" {:>{}}", curve.key, widthOf(curve));
    std::string scores;
    for (const objectives::Objective* objective : study::summedObjectives(settings))
        scores += fmt::format(" {:>{}}", objective->symbol, widthOf(*objective));
    const std::string winner = fmt::format("{:>9} {:>8}{}", "finished", "F", scores);
    const std::string top = fmt::format("{:>8} {:>8}{}", "success", "F", scores);
    return fmt::format(
        "{:>10} {:>7}   {:>15} {:^{}} {:^{}} {:^{}}\n"
        "{:>10} {:>7}   {:>15} {} {}{} {:>7}\n",
        "", "[%]", "95 % [%]", "the generation's winner", winner.size(), "[%]    mean of the top 30 %",
        top.size(), "the search", std::max<std::size_t>(curves.size(), 1) - 1, "Generation",
        successName(settings), "Clopper-Pearson", winner, top, curves, "seconds");
}

Attempt<LearningRun> runLearning(store::StudyFile& file, const study::StudyInputs& inputs,
                                 const Console& console, std::optional<double> timeLimit) {
    study::LearningControl control;
    Situation situation(inputs.settings.evolution, control.run);
    const Clock::time_point begin = Clock::now();
    bool timeOver = false;
    auto learned = [&] {
        WorkDisplay display(console, watchLearning(situation, begin, control, console));
        workflow::LearnEvents events;
        bool toldWanted = false;
        events.planned = [&](const study::GenerationPlan& plan) {
            situation.setPlan(plan);
            if (toldWanted || !plan.wantedUnturned) return;
            toldWanted = true;
            display.print(describeUnturned(*plan.wantedUnturned));
        };
        events.saved = [&](const study::GenerationRecord& record) {
            situation.setSuccess(successOf(inputs.settings.evolution, record));
            display.print(describeGeneration(inputs.settings.evolution, record));
            if (timeLimit && secondsSince(begin) + record.seconds > *timeLimit) {
                timeOver = true;
                control.stopAfterGeneration();
            }
        };
        events.checked = [&](const study::CheckRecord& record) {
            display.print(describeCheck(inputs.settings.evolution, record));
        };
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
        if (!finished) return finished.error();
        ran.interrupted = !*finished;
    }
    noteRemadeTrials(inputs, console);
    if (const auto there = file.checkInPlace(); !there)
        return toFailure({workflow::FailureKind::saving, there.error().message}, file);
    return ran;
}

Attempt<study::LearningEnd> followLearning(store::StudyFile& file, const study::Settings& settings,
                                           const workflow::ClusterJob& job, const Console& console) {
    const auto nameOf = [](const workflow::JobStatus& status) -> std::string {
        switch (status.state) {
            case workflow::JobState::waiting:
                return "waits in the queue" + (status.reason.empty() ? "" : " (" + status.reason + ")");
            case workflow::JobState::running:
                return "runs";
            case workflow::JobState::over:
                return "is over";
            case workflow::JobState::unknown:
                break;
        }
        return "is not known: the batch system does not answer";
    };
    std::mutex mutex;
    std::string state = "was queued";
    int generations = 0;
    const auto describe = [&] {
        const std::lock_guard lock(mutex);
        return fmt::format("Job {} {}, {} generations", job.id, state, generations);
    };
    study::LearningControl control;
    WorkWatch watch;
    watch.progress = describe;
    watch.interrupted = [control, &console](int count) mutable {
        control.stopAfterGeneration();
        if (count == 1) {
            console.note("The job stops after its generation. Ctrl-C once more stops it at once.");
        } else {
            control.run.cancel();
        }
    };
    const auto count = file.generationCount();
    if (!count) return Failure{ExitCode::badInput, count.error().message};
    generations = *count;
    auto followed = [&] {
        WorkDisplay display(console, std::move(watch));
        workflow::LearnEvents events;
        events.saved = [&](const study::GenerationRecord& record) {
            {
                const std::lock_guard lock(mutex);
                generations = record.index + 1;
            }
            display.print(describeGeneration(settings.evolution, record));
        };
        events.checked = [&](const study::CheckRecord& record) {
            display.print(describeCheck(settings.evolution, record));
        };
        return workflow::followJob(
            file, job, events,
            [&](const workflow::JobStatus& now) {
                const std::lock_guard lock(mutex);
                state = nameOf(now);
            },
            control);
    }();
    if (!followed) return toFailure(followed.error(), file);
    return *followed;
}

}  // namespace trapwright::app
