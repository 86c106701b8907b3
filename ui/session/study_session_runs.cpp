#include "core/workflow/judging.h"
#include "core/workflow/learning.h"
#include "ui/session/recovery_note.h"
#include "ui/session/study_session_state.h"

namespace trapwright::session {

namespace {

using Failed = std::optional<workflow::Failure>;

Failed settingsFailure(const base::Error& error) {
    return workflow::Failure{workflow::FailureKind::settings, error.message};
}

}  // namespace

RunState StudySession::state() const {
    if (state_->activity != RunState::idle) return state_->activity;
    return state_->simulations > 0 ? RunState::simulating : RunState::idle;
}

RunProgress StudySession::progress() const {
    RunProgress progress;
    const Run* const run = state_->run.get();
    if (run == nullptr) return progress;
    const double seconds = run->seconds();
    if (run->kind == RunState::learning) {
        progress.generations = state_->settings.evolution.generations;
        progress.generation = run->plan ? run->plan->generation : static_cast<int>(state_->summaries.size());
        progress.individuals = state_->settings.evolution.populationSize;
    }
    if (run->plan) {
        const study::GenerationPlan& plan = *run->plan;
        const std::int64_t done = run->learning.run.done();
        const study::LearningProgress learned =
            study::estimateProgress(plan, progress.generations, done, seconds);
        progress.individualsDone = learned.individualsDone;
        progress.trialsDone = done - plan.doneBefore;
        progress.trials = plan.trials;
        progress.trialsPerSecond = learned.trialsPerSecond;
        progress.secondsLeft = learned.secondsLeft;
    } else if (run->total > 0) {
        progress.trialsDone = run->trials.done();
        progress.trials = run->total;
        if (progress.trialsDone > 0 && seconds > 0.0) {
            progress.trialsPerSecond = static_cast<double>(progress.trialsDone) / seconds;
            progress.secondsLeft =
                static_cast<double>(progress.trials - progress.trialsDone) / progress.trialsPerSecond;
        }
    }
    return progress;
}

void StudySession::startRun(RunState kind, const QString& what, std::function<Failed(Run&)> work) {
    if (state_->run) {
        emit failed(what, tr("The study is at work already. Wait for its end, or stop it first."));
        return;
    }
    if (!state_->problems.empty()) {
        QString message = tr("The settings cannot be used:");
        for (const std::string& problem : state_->problems)
            message += "\n" + QString::fromStdString(problem);
        emit failed(what, message);
        return;
    }
    state_->estimate.cancel();
    auto run = std::make_shared<Run>();
    run->kind = kind;
    run->what = what;
    run->clock.start();
    state_->run = run;
    setActivity(kind);
    state_->tick.start();
    state_->work->post([this, run, work = std::move(work)] {
        Failed failure = work(*run);
        tell(this, [this, failure = std::move(failure)] { endRun(failure); });
    });
}

void StudySession::endRun(const Failed& failure) {
    const std::shared_ptr<Run> run = std::exchange(state_->run, nullptr);
    state_->tick.stop();
    // Before the state: that a run failed is told while the study is at work.
    if (failure && failure->kind != workflow::FailureKind::cancelled)
        emit failed(run->what, QString::fromStdString(failure->message));
    setActivity(RunState::idle);
}

void StudySession::setActivity(RunState activity) {
    state_->activity = activity;
    tellState();
}

void StudySession::tellState() {
    const RunState now = state();
    if (std::exchange(state_->told, now) != now) emit stateChanged(now);
}

void StudySession::startLearning() {
    // What was changed before may no longer be undone: the scores to come belong to it.
    if (!locked() && state_->problems.empty()) state_->undo.clear();
    startRun(RunState::learning, tr("The study could not learn"),
             [this, settings = state_->settings, part = state_->part.part,
              threads = state_->threads](Run& run) { return learn(run, settings, part, threads); });
}

std::optional<workflow::Failure> StudySession::learn(Run& run, const study::Settings& settings,
                                                     const std::shared_ptr<const part::Part>& part,
                                                     unsigned threads) {
    const RecoveryNote note(state_->environment.stateFolder, state_->writer.file().path());
    const trial::EngineRegistry& engines = state_->environment.engines;
    const auto inputs =
        State::makeInputs(state_->environment, settings, part, trial::EngineUse::learning, threads);
    if (!inputs) return settingsFailure(inputs.error());

    workflow::LearnEvents events;
    events.planned = [this](const study::GenerationPlan& plan) {
        tell(this, [this, plan] { state_->run->plan = plan; });
    };
    events.saved = [this](const study::GenerationRecord& record) {
        const study::GenerationSummary summary = study::summarize(record);
        const study::Individual winner{{record.index, record.winner},
                                       record.individuals[static_cast<std::size_t>(record.winner)]};
        tell(this, [this, summary, winner, kept = std::make_shared<const study::GenerationRecord>(record)] {
            state_->summaries.push_back(summary);
            state_->winners.push_back(winner);
            state_->newest = kept;
            emit generationSaved(summary.index);
        });
        savePending();
    };
    events.checked = [this](const study::CheckRecord& check) {
        tell(this, [this, check] {
            state_->checks.push_back(check);
            emit checkSaved(check.generation);
        });
    };
    const auto report = workflow::learn(state_->writer.file(), *inputs, engines, events, run.learning);
    if (!report) return report.error();
    // Who asked to stop did not ask for the checks that are left.
    if (report->end != study::LearningEnd::completed || run.learning.stopRequested()) return std::nullopt;
    tell(this, [this, total = workflow::countCheckTrials(report->unchecked)] {
        state_->run->plan.reset();
        state_->run->total = total;
    });
    const auto checked = workflow::checkWinners(state_->writer.file(), *inputs, engines, report->unchecked,
                                                events.checked, run.trials);
    if (!checked) return checked.error();
    return std::nullopt;
}

void StudySession::startSelection() {
    const auto work = [this, settings = state_->settings, part = state_->part.part,
                       threads = state_->threads](Run& run) -> Failed {
        const auto inputs =
            State::makeInputs(state_->environment, settings, part, trial::EngineUse::judging, threads);
        if (!inputs) return settingsFailure(inputs.error());
        auto candidates = workflow::findCandidates(state_->writer.file(), *inputs);
        if (!candidates) return candidates.error();
        tell(this, [this, count = static_cast<std::int64_t>(candidates->size()),
                    each = settings.validation.selectionTrials] { state_->run->total = count * each; });
        auto record =
            workflow::selectAndSave(state_->writer.file(), *inputs, std::move(*candidates), run.trials);
        if (!record) return record.error();
        tell(this, [this, record = std::move(*record)] {
            state_->selections.push_back(record);
            state_->found.reset();
            emit selectionSaved();
        });
        return std::nullopt;
    };
    startRun(RunState::selecting, tr("The winners could not be compared"), work);
}

void StudySession::startValidation(const study::Individual& winner,
                                   const std::optional<base::Quaternion>& expected) {
    const auto work = [this, winner, expected, settings = state_->settings, part = state_->part.part,
                       threads = state_->threads](Run& run) -> Failed {
        const auto inputs =
            State::makeInputs(state_->environment, settings, part, trial::EngineUse::judging, threads);
        if (!inputs) return settingsFailure(inputs.error());
        tell(this, [this, total = workflow::countValidationTrials(*inputs)] { state_->run->total = total; });
        auto record = workflow::validateAndSave(state_->writer.file(), *inputs, winner, expected, run.trials);
        if (!record) return record.error();
        tell(this, [this, record = std::move(*record)] {
            state_->validations.push_back(record);
            state_->found.reset();
            emit validationSaved();
        });
        return std::nullopt;
    };
    startRun(RunState::validating, tr("The track could not be validated"), work);
}

void StudySession::pause() {
    Run* const run = state_->run.get();
    if (run == nullptr || run->paused || state_->activity != run->kind) return;
    run->learning.pause();
    run->trials.pause();
    run->before += run->clock.elapsed();
    run->paused = true;
    state_->tick.stop();
    setActivity(RunState::paused);
}

void StudySession::resume() {
    if (state_->activity != RunState::paused) return;
    goOn();
    setActivity(state_->run->kind);
}

void StudySession::goOn() {
    Run& run = *state_->run;
    if (!run.paused) return;
    run.paused = false;
    run.clock.restart();
    run.learning.resume();
    run.trials.resume();
    state_->tick.start();
}

void StudySession::stopAfterGeneration() {
    if (!state_->run || state_->activity == RunState::stopping) return;
    // Only generations can be waited for.
    if (state_->run->kind != RunState::learning || state_->run->total > 0) return stopNow();
    state_->run->learning.stopAfterGeneration();
    goOn();
    setActivity(RunState::stoppingAfterGeneration);
}

void StudySession::stopNow() {
    if (!state_->run) return;
    state_->run->cancel();
    goOn();
    setActivity(RunState::stopping);
}

}  // namespace trapwright::session
