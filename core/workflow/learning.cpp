#include "core/workflow/learning.h"

#include <chrono>
#include <optional>

namespace trapwright::workflow {

Result<LearningReport> learn(store::StudyFile& file, const study::StudyInputs& inputs,
                             const trial::EngineRegistry& engines, const LearnEvents& events,
                             const study::LearningControl& control) {
    const auto last = file.loadLearningState();
    if (!last) return Failure{FailureKind::reading, last.error().message};
    const auto started = WinnerChecks::start(file, inputs, engines, control.checks);
    if (!started) return started.error();
    WinnerChecks* const checks = started->get();

    const auto begin = std::chrono::steady_clock::now();
    const std::int64_t doneBefore = control.run.done();
    FailureKind kind = FailureKind::simulation;
    study::LearningEvents watch;
    watch.planned = events.planned;
    watch.save = [&](study::GenerationRecord& record) -> base::Status {
        kind = FailureKind::saving;
        if (auto saved = file.saveGeneration(record); !saved) return saved;
        record.made = {};
        if (events.saved) events.saved(record);
        if (checks != nullptr) {
            checks->add(record);
            if (auto saved = checks->save(events.checked); !saved) return saved;
        }
        kind = FailureKind::simulation;
        return base::success();
    };
    const auto end = study::evolve(inputs, *last, watch, control);
    if (!end) {
        if (kind == FailureKind::saving) return describeSaving(end.error());
        if (end.error().kind == base::ErrorKind::damaged) {
            return Failure{FailureKind::reading, "The study " + file.path().string() +
                                                     " is damaged: learning cannot go on after its last "
                                                     "generation. " +
                                                     end.error().message + " Restore it from a copy."};
        }
        return Failure{kind, end.error().message};
    }

    LearningReport report;
    report.end = *end;
    if (checks != nullptr) {
        auto left = checks->stop(events.checked);
        if (!left) return describeSaving(left.error());
        report.unchecked = std::move(*left);
    }
    report.trials = control.run.done() - doneBefore;
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return report;
}

}  // namespace trapwright::workflow
