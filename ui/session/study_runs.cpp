#include "ui/session/study_runs.h"

#include <algorithm>
#include <utility>

#include "core/base/parallel.h"
#include "core/study/evaluator.h"
#include "core/study/pose_weights.h"
#include "core/study/selection.h"
#include "core/study/track_design.h"
#include "core/workflow/estimate.h"
#include "core/workflow/learning.h"
#include "ui/session/recovery_note.h"
#include "ui/session/study_state.h"

namespace trapwright::session {

namespace {

constexpr int kTick = 250;               // between two progressed() [ms]
constexpr double kEstimateBudget = 1.0;  // [s]

using Failed = std::optional<workflow::Failure>;

Failed settingsFailure(const base::Error& error) {
    return workflow::Failure{workflow::FailureKind::settings, error.message};
}

base::Result<study::StudyInputs> makeInputs(const Environment& environment, const study::Settings& settings,
                                            std::shared_ptr<const part::Part> part, trial::EngineUse use,
                                            unsigned threads,
                                            std::shared_ptr<trial::RemadeTrials> remade = nullptr) {
    const unsigned count = threads == 0 ? base::availableThreads() : threads;
    auto engine = environment.engines.make(environment.engines.nameFor(settings.simulation.engine, use),
                                           {count, 0.0, nullptr, remade});
    if (!engine) return engine.error();
    return study::StudyInputs{settings, std::move(part), std::move(*engine), count, std::move(remade)};
}

}  // namespace

bool isJudging(RunState state) {
    return state == RunState::selecting || state == RunState::validating || state == RunState::measuring ||
           state == RunState::streaming || state == RunState::mending;
}

StudyRuns::StudyRuns(StudyState& state, const StudyDesign& design) : state_(&state), design_(design) {
    tick_.setInterval(kTick);
    connect(&tick_, &QTimer::timeout, this, [this] { emit progressed(progress()); });
    state_->simulationsChanged = [this] { tellState(); };
}

const std::vector<study::GenerationSummary>& StudyRuns::summaries() const {
    return state_->summaries;
}

const std::vector<study::Individual>& StudyRuns::winners() const {
    return state_->winners;
}

const std::vector<study::CheckRecord>& StudyRuns::checks() const {
    return state_->checks;
}

const std::vector<study::SelectionRecord>& StudyRuns::selections() const {
    return state_->selections;
}

const std::vector<study::ValidationRecord>& StudyRuns::validations() const {
    return state_->validations;
}

const study::RobustnessRecord* StudyRuns::findRobustness(const study::IndividualId& individual) const {
    const auto found = std::ranges::find_if(state_->robustness, [&](const study::RobustnessRecord& record) {
        return isSameIndividual(record, individual);
    });
    return found == state_->robustness.end() ? nullptr : &*found;
}

const std::vector<study::RobustnessRecord>& StudyRuns::robustness() const {
    return state_->robustness;
}

const study::StreamsRecord* StudyRuns::findStreams(const study::IndividualId& individual) const {
    const auto found = std::ranges::find_if(state_->streams, [&](const study::StreamsRecord& record) {
        return isSameIndividual(record, individual);
    });
    return found == state_->streams.end() ? nullptr : &*found;
}

std::vector<study::IndividualId> StudyRuns::listUnmeasured() const {
    std::vector<study::IndividualId> unmeasured;
    if (state_->selections.empty()) return unmeasured;
    for (const study::SelectionEntry& entry : state_->selections.back().entries) {
        const study::RobustnessRecord* known = findRobustness(entry);
        if (known == nullptr || !(known->box == state_->settings.box)) unmeasured.push_back(entry);
    }
    return unmeasured;
}

const study::Individual* StudyRuns::bestWinner() const {
    return study::findBestWinner(state_->winners, study::forgivesFalls(state_->settings.evolution));
}

std::optional<study::TrackSuccess> StudyRuns::findSuccess(const study::Individual& individual) const {
    std::vector<part::PoseGroup> groups;
    const auto& part = state_->part.part;
    if (part && !validations().empty()) groups = study::weighPoseGroups(*part, state_->settings);
    return study::findSuccess(selections(), validations(), individual, groups,
                              study::forgivesFalls(state_->settings.evolution));
}

base::Result<study::GenerationRecord> StudyRuns::loadGeneration(int index) const {
    // Who follows a run asks for this one, and the disk may be busy just then.
    if (newest_ && newest_->index == index) return *newest_;
    if (!state_->reader) return state_->cannotRead();
    return state_->reader->loadGeneration(index);
}

base::Result<study::Individual> StudyRuns::loadIndividual(const study::IndividualId& id) const {
    if (id.generation >= 0 && id.generation < static_cast<int>(state_->winners.size())) {
        const study::Individual& winner = state_->winners[static_cast<std::size_t>(id.generation)];
        if (isSameIndividual(winner, id)) return winner;
    }
    if (!state_->reader) return state_->cannotRead();
    auto record = state_->reader->loadIndividual(id);
    if (!record) return record.error();
    return study::Individual{id, std::move(*record)};
}

std::optional<study::IndividualId> StudyRuns::mendedFrom(int generation) const {
    const std::vector<study::GenerationSummary>& all = summaries();
    if (generation < 0 || generation >= static_cast<int>(all.size())) return std::nullopt;
    return all[static_cast<std::size_t>(generation)].mendedFrom;
}

std::optional<study::Individual> StudyRuns::chosen() const {
    if (state_->chosen) return state_->chosen;
    if (!state_->selections.empty() && !state_->selections.back().entries.empty()) {
        const study::SelectionEntry& best = state_->selections.back().entries.front();
        if (auto winner = loadIndividual(best)) return *winner;
    }
    if (const study::Individual* best = bestWinner()) return *best;
    return std::nullopt;
}

void StudyRuns::choose(const study::Individual& individual) {
    state_->chosen = individual;
    const study::IndividualId place = individual;
    state_->note([place](store::StudyFile& file) { return file.chooseWinner(place); });
    emit chosenChanged();
}

RunState StudyRuns::state() const {
    if (activity_ != RunState::idle) return activity_;
    return state_->simulations > 0 ? RunState::simulating : RunState::idle;
}

RunProgress StudyRuns::progress() const {
    RunProgress progress;
    const Run* const run = state_->run.get();
    if (run == nullptr) return progress;
    const double seconds = run->seconds();
    if (run->kind == RunState::learning) {
        progress.generations = state_->settings.evolution.generations;
        progress.generation = run->plan ? run->plan->generation : static_cast<int>(state_->summaries.size());
        progress.individuals = state_->settings.evolution.populationSize;
    }
    if (run->kind == RunState::following) {
        const study::EvolutionSettings& evolution = state_->settings.evolution;
        progress.job = run->job;
        progress.generations = evolution.generations;
        progress.generation = static_cast<int>(state_->summaries.size());
        progress.trialsPerSecond = lateRate(run->firstGeneration);
        const int left = std::max(evolution.generations - progress.generation, 0);
        if (progress.trialsPerSecond > 0.0)
            progress.secondsLeft = static_cast<double>(left) * evolution.populationSize *
                                   evolution.trialsPerEvaluation / progress.trialsPerSecond;
        return progress;
    }
    if (run->plan) {
        const study::GenerationPlan& plan = *run->plan;
        const std::int64_t done = run->learning.run.done();
        const study::LearningProgress learned =
            study::estimateProgress(plan, progress.generations, done, seconds);
        progress.individualsDone = learned.individualsDone;
        progress.trialsDone = done - plan.doneBefore;
        progress.trials = plan.trials;
        progress.isPlanning = plan.planningFor > 0;
        progress.wantedUnturned = plan.wantedUnturned;
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

std::vector<trial::RemadeTrial> StudyRuns::remadeTrials() const {
    return remade_ ? remade_->list() : std::vector<trial::RemadeTrial>();
}

void StudyRuns::startRun(RunState kind, const QString& what, std::function<Failed(Run&)> work) {
    if (state_->run) {
        state_->fail(what, tr("The study is at work already. Wait for its end, or stop it first."));
        return;
    }
    if (!state_->problems.empty()) {
        QString message = tr("The settings cannot be used:");
        for (const std::string& problem : state_->problems)
            message += "\n" + QString::fromStdString(problem);
        state_->fail(what, message);
        return;
    }
    state_->estimate.cancel();
    state_->proposing.cancel();
    auto run = std::make_shared<Run>();
    run->kind = kind;
    run->what = what;
    run->firstGeneration = static_cast<int>(state_->summaries.size());
    run->remade = std::make_shared<trial::RemadeTrials>();
    run->clock.start();
    state_->run = run;
    remade_ = run->remade;
    setActivity(kind);
    tick_.start();
    state_->work->post([this, run, work = std::move(work)] {
        Failed failure = work(*run);
        state_->tell([this, failure = std::move(failure)] { endRun(failure); });
    });
}

void StudyRuns::endRun(const Failed& failure) {
    const std::shared_ptr<Run> run = std::exchange(state_->run, nullptr);
    tick_.stop();
    // Before the state: that a run failed is told while the study is at work.
    if (failure && failure->kind != workflow::FailureKind::cancelled)
        state_->fail(run->what, QString::fromStdString(failure->message));
    setActivity(RunState::idle);
}

void StudyRuns::setActivity(RunState activity) {
    activity_ = activity;
    tellState();
}

void StudyRuns::tellState() {
    const RunState now = state();
    if (std::exchange(told_, now) != now) emit stateChanged(now);
}

void StudyRuns::startLearning() {
    // What was changed before may no longer be undone: the scores to come belong to it.
    const study::EvolutionSettings& evolution = state_->settings.evolution;
    const int next = static_cast<int>(state_->summaries.size());
    const bool beginsCorners =
        study::cornerShareIn(evolution, next) > 0.0 && study::cornerShareIn(evolution, next - 1) == 0.0;
    if ((!state_->locked() || beginsCorners) && state_->problems.empty()) state_->undo.clear();
    startRun(RunState::learning, tr("The study could not learn"),
             [this, settings = state_->settings, part = state_->part.part,
              threads = state_->threads](Run& run) { return learn(run, settings, part, threads); });
}

std::optional<workflow::Failure> StudyRuns::learn(Run& run, const study::Settings& settings,
                                                  const std::shared_ptr<const part::Part>& part,
                                                  unsigned threads) {
    const RecoveryNote note(state_->environment.stateFolder, state_->writer.file().path());
    const trial::EngineRegistry& engines = state_->environment.engines;
    const auto inputs =
        makeInputs(state_->environment, settings, part, trial::EngineUse::learning, threads, run.remade);
    if (!inputs) return settingsFailure(inputs.error());

    const workflow::LearnEvents events = learnEvents();
    const auto report = workflow::learn(state_->writer.file(), *inputs, engines, events, run.learning);
    if (!report) return report.error();
    // Who asked to stop did not ask for the checks that are left.
    if (report->end != study::LearningEnd::completed || run.learning.stopRequested()) return std::nullopt;
    state_->tell([this, total = workflow::countCheckTrials(report->unchecked)] {
        state_->run->plan.reset();
        state_->run->total = total;
    });
    const auto checked = workflow::checkWinners(state_->writer.file(), *inputs, engines, report->unchecked,
                                                events.checked, run.trials);
    if (!checked) return checked.error();
    return std::nullopt;
}

workflow::LearnEvents StudyRuns::learnEvents() {
    workflow::LearnEvents events;
    events.planned = [this](const study::GenerationPlan& plan) {
        state_->tell([this, plan] { state_->run->plan = plan; });
    };
    events.saved = [this](const study::GenerationRecord& record) { tellGeneration(record); };
    events.checked = [this](const study::CheckRecord& check) {
        state_->tell([this, check] {
            state_->checks.push_back(check);
            emit checkSaved(check.generation);
        });
    };
    return events;
}

void StudyRuns::startJob(const workflow::JobPlan& plan) {
    if (!state_->locked() && state_->problems.empty()) state_->undo.clear();
    const auto work = [this, plan](Run& run) -> Failed {
        // The copy has what was changed last.
        if (const auto saved = state_->writer.savePending(); !saved)
            return workflow::Failure{workflow::FailureKind::saving, saved.error().message};
        const store::StudyFile& file = state_->writer.file();
        const std::filesystem::path folder = workflow::findNextFolder(file.path());
        const auto job = workflow::canSubmit() ? workflow::writeAndSubmit(file, folder, plan)
                                               : workflow::writeJob(file, folder, plan);
        if (!job) return workflow::Failure{workflow::FailureKind::simulation, job.error().message};
        state_->tell([this, job = *job] { emit jobWritten(job); });
        if (job->id.empty()) return std::nullopt;
        return follow(run, *job);
    };
    startRun(RunState::following, tr("The study could not be given to a cluster"), work);
}

void StudyRuns::followJob(const workflow::ClusterJob& job) {
    startRun(RunState::following, tr("What the job learned could not be taken"),
             [this, job](Run& run) { return follow(run, job); });
}

std::optional<workflow::ClusterJob> StudyRuns::lastJob() const {
    const std::filesystem::path folder = workflow::findLastFolder(state_->path);
    if (folder.empty()) return std::nullopt;
    auto job = workflow::readJob(folder);
    return job ? std::optional(std::move(*job)) : std::nullopt;
}

void StudyRuns::followLastJob() {
    if (state_->run) return;
    const auto job = lastJob();
    if (job && !job->id.empty() && !job->isOver) followJob(*job);
}

std::optional<workflow::Failure> StudyRuns::follow(Run& run, const workflow::ClusterJob& job) {
    tellJob({job.id});
    const auto end = workflow::followJob(
        state_->writer.file(), job, learnEvents(),
        [this, id = job.id](const workflow::JobStatus& now) {
            tellJob({id, now});
        },
        run.learning, run.leaving);
    if (!end) return end.error();
    const bool isWanted = run.learning.stopRequested() || run.learning.run.cancelled();
    if (*end != study::LearningEnd::stopped || isWanted || job.id.empty()) return std::nullopt;
    const std::string said = workflow::readLastWords(job);
    return workflow::Failure{workflow::FailureKind::simulation,
                             tr("Job %1 ended before the last generation. What it learned is saved. %2")
                                 .arg(QString::fromStdString(job.id),
                                      said.empty() ? tr("It said nothing; its folder is %1.")
                                                         .arg(QString::fromStdString(job.folder.string()))
                                                   : tr("It said last: %1").arg(QString::fromStdString(said)))
                                 .toStdString()};
}

void StudyRuns::tellJob(const FollowedJob& job) {
    state_->tell([this, job] {
        if (!state_->run || state_->run->job == job) return;
        state_->run->job = job;
        emit jobChanged(job);
    });
}

void StudyRuns::tellGeneration(const study::GenerationRecord& record) {
    const study::GenerationSummary summary = study::summarize(record);
    const study::Individual winner{{record.index, record.winner},
                                   record.individuals[static_cast<std::size_t>(record.winner)]};
    state_->tell([this, summary, winner, kept = std::make_shared<const study::GenerationRecord>(record)] {
        state_->summaries.push_back(summary);
        state_->winners.push_back(winner);
        newest_ = kept;
        emit generationSaved(summary.index);
    });
    state_->savePending();
}

void StudyRuns::startSelection() {
    const auto work = [this, settings = state_->settings, part = state_->part.part,
                       threads = state_->threads](Run& run) -> Failed {
        const auto inputs =
            makeInputs(state_->environment, settings, part, trial::EngineUse::judging, threads, run.remade);
        if (!inputs) return settingsFailure(inputs.error());
        auto candidates = workflow::findCandidates(state_->writer.file(), *inputs);
        if (!candidates) return candidates.error();
        state_->tell([this, count = static_cast<std::int64_t>(candidates->size()),
                      each = settings.validation.selectionTrials + study::countCornerTrials(settings)] {
            state_->run->total = count * each;
        });
        auto record =
            workflow::selectAndSave(state_->writer.file(), *inputs, std::move(*candidates), run.trials);
        if (!record) return record.error();
        state_->tell([this, record = std::move(*record)] {
            state_->selections.push_back(record);
            state_->found.reset();
            emit selectionSaved();
        });
        return std::nullopt;
    };
    startRun(RunState::selecting, tr("The winners could not be compared"), work);
}

void StudyRuns::startValidation(const study::Individual& winner, const std::optional<trial::Goal>& expected) {
    const auto work = [this, winner, expected, settings = state_->settings, part = state_->part.part,
                       threads = state_->threads](Run& run) -> Failed {
        const auto inputs =
            makeInputs(state_->environment, settings, part, trial::EngineUse::judging, threads, run.remade);
        if (!inputs) return settingsFailure(inputs.error());
        state_->tell(
            [this, total = workflow::countValidationTrials(*inputs)] { state_->run->total = total; });
        auto record = workflow::validateAndSave(state_->writer.file(), *inputs, winner, expected, run.trials);
        if (!record) return record.error();
        state_->tell([this, record = std::move(*record)] {
            state_->validations.push_back(record);
            state_->found.reset();
            emit validationSaved();
        });
        return std::nullopt;
    };
    startRun(RunState::validating, tr("The track could not be validated"), work);
}

void StudyRuns::startRobustness(const std::vector<study::Individual>& tracks,
                                const study::RobustnessPlan& plan, const std::optional<trial::Goal>& goal) {
    const auto work = [this, tracks, plan, goal, settings = state_->settings, part = state_->part.part,
                       threads = state_->threads](Run& run) -> Failed {
        const auto inputs =
            makeInputs(state_->environment, settings, part, trial::EngineUse::learning, threads, run.remade);
        if (!inputs) return settingsFailure(inputs.error());
        const auto count = static_cast<int>(tracks.size());
        state_->tell([this, total = count * study::countRobustnessTrials(settings, plan)] {
            state_->run->total = total;
        });
        for (const study::Individual& track : tracks) {
            auto record =
                workflow::measureAndSave(state_->writer.file(), *inputs, track, goal, plan, run.trials);
            if (!record) return record.error();
            state_->tell([this, count, record = std::move(*record)] {
                std::erase_if(state_->robustness, [&](const study::RobustnessRecord& one) {
                    return isSameIndividual(one, record);
                });
                state_->robustness.push_back(record);
                emit robustnessMeasured(count);
            });
        }
        return std::nullopt;
    };
    startRun(RunState::measuring,
             tracks.size() > 1 ? tr("The robustness of the tracks could not be measured")
                               : tr("The track's robustness could not be measured"),
             work);
}

void StudyRuns::startStreams(const study::Individual& track, const std::vector<double>& inflows,
                             const std::optional<trial::Goal>& goal) {
    const auto work = [this, track, inflows, goal, settings = state_->settings, part = state_->part.part,
                       threads = state_->threads](Run& run) -> Failed {
        const auto inputs =
            makeInputs(state_->environment, settings, part, trial::EngineUse::learning, threads, run.remade);
        if (!inputs) return settingsFailure(inputs.error());
        state_->tell([this, total = static_cast<std::int64_t>(inflows.size()) * settings.stream.streams] {
            state_->run->total = total;
        });
        auto record =
            workflow::measureStreamsAndSave(state_->writer.file(), *inputs, track, goal, inflows, run.trials);
        if (!record) return record.error();
        state_->tell([this, record = std::move(*record)] {
            std::erase_if(state_->streams,
                          [&](const study::StreamsRecord& one) { return isSameIndividual(one, record); });
            state_->streams.push_back(record);
            emit streamsMeasured();
        });
        return std::nullopt;
    };
    startRun(RunState::streaming, tr("The stream of parts could not be simulated"), work);
}

void StudyRuns::startMending(const study::Individual& track, const study::MendingPlan& plan) {
    const auto work = [this, track, plan, settings = state_->settings, part = state_->part.part,
                       threads = state_->threads](Run& run) -> Failed {
        const auto inputs =
            makeInputs(state_->environment, settings, part, trial::EngineUse::learning, threads, run.remade);
        if (!inputs) return settingsFailure(inputs.error());
        state_->tell(
            [this, total = workflow::countMendingTrials(settings, plan)] { state_->run->total = total; });
        const auto saved = [this](const study::GenerationRecord& record) { tellGeneration(record); };
        auto report = workflow::mendAndSave(state_->writer.file(), *inputs, track, plan, saved, run.trials);
        if (!report) return report.error();
        state_->tell([this, report = std::move(*report)] {
            state_->selections.push_back(report.selection);
            state_->found.reset();
            const auto at = static_cast<std::size_t>(report.best.individual);
            state_->chosen = {report.best, report.generation.individuals[at]};
            emit selectionSaved();
            emit chosenChanged();
            emit mended(report);
        });
        return std::nullopt;
    };
    startRun(RunState::mending, tr("The track could not be mended"), work);
}

void StudyRuns::pause() {
    Run* const run = state_->run.get();
    if (run == nullptr || run->paused || activity_ != run->kind || run->kind == RunState::following) return;
    run->learning.pause();
    run->trials.pause();
    run->before += run->clock.elapsed();
    run->paused = true;
    tick_.stop();
    setActivity(RunState::paused);
}

void StudyRuns::resume() {
    if (activity_ != RunState::paused) return;
    goOn();
    setActivity(state_->run->kind);
}

void StudyRuns::goOn() {
    Run& run = *state_->run;
    if (!run.paused) return;
    run.paused = false;
    run.clock.restart();
    run.learning.resume();
    run.trials.resume();
    tick_.start();
}

void StudyRuns::stopAfterGeneration() {
    if (!state_->run || activity_ == RunState::stopping) return;
    // Only generations can be waited for.
    const bool learns = state_->run->kind == RunState::learning || state_->run->kind == RunState::following;
    if (!learns || state_->run->total > 0) return stopNow();
    state_->run->learning.stopAfterGeneration();
    goOn();
    setActivity(RunState::stoppingAfterGeneration);
}

void StudyRuns::stopNow() {
    if (!state_->run) return;
    state_->run->cancel();
    goOn();
    setActivity(RunState::stopping);
}

unsigned StudyRuns::threads() const {
    return state_->threads;
}

void StudyRuns::setThreads(unsigned threads) {
    if (state_->threads == threads) return;
    state_->threads = threads;
    state_->forgetCost();
    emit estimated(0.0);
}

void StudyRuns::requestEstimate() {
    state_->estimate.cancel();
    if (state_->run || state_->simulations > 0 || !state_->problems.empty()) return;
    state_->estimate = base::RunControl();
    state_->simulating->post([this, control = state_->estimate, settings = state_->settings,
                              part = state_->part.part, threads = state_->threads] {
        if (control.cancelled()) return;
        const auto inputs =
            makeInputs(state_->environment, settings, part, trial::EngineUse::learning, threads);
        if (!inputs) return;
        const auto cost = workflow::timeTrials(*inputs, kEstimateBudget, control);
        if (!cost) return;
        state_->tell([this, control, cost = *cost] {
            if (control.cancelled()) return;
            state_->trialCost = cost;
            emit estimated(estimatedSeconds());
        });
    });
}

void StudyRuns::requestProposal(double seconds) {
    state_->proposing.cancel();
    if (state_->run || state_->part.part == nullptr) return;
    state_->proposing = base::RunControl();
    state_->simulating->post([this, seconds, control = state_->proposing, settings = state_->settings,
                              part = state_->part.part, threads = state_->threads] {
        if (control.cancelled()) return;
        const auto inputs =
            makeInputs(state_->environment, settings, part, trial::EngineUse::learning, threads);
        const auto proposal = inputs ? workflow::proposeSettings(*inputs, seconds, control)
                                     : base::Result<workflow::Proposal>(base::Error{inputs.error().message});
        state_->tell([this, control, settings, proposal] {
            if (control.cancelled()) return;
            // What was changed meanwhile is the user's.
            if (state_->settings != settings) return emit estimated(estimatedSeconds());
            if (proposal) return emit proposed(*proposal);
            emit estimated(estimatedSeconds());
            state_->fail(tr("Settings for the part and the time"),
                         QString::fromStdString(proposal.error().message));
        });
    });
}

double StudyRuns::estimatedSeconds() const {
    const study::EvolutionSettings& evolution = state_->settings.evolution;
    const int left = evolution.generations - static_cast<int>(state_->summaries.size());
    return workflow::learningTime(evolution, std::max(left, 0), state_->trialCost);
}

double StudyRuns::lateRate(int since) const {
    constexpr std::size_t kLately = 5;  // generations
    std::vector<double> rates;
    for (auto i = summaries().rbegin(); i != summaries().rend() && rates.size() < kLately; ++i)
        if (i->index >= since && i->trialsPerSecond() > 0.0) rates.push_back(i->trialsPerSecond());
    if (rates.empty()) return 0.0;
    const auto middle = rates.begin() + static_cast<std::ptrdiff_t>(rates.size() / 2);
    std::nth_element(rates.begin(), middle, rates.end());
    return *middle;
}

double StudyRuns::secondsFor(std::int64_t trials) const {
    const double rate = lateRate();
    return rate > 0.0 ? static_cast<double>(trials) / rate : 0.0;
}

std::optional<LearningDraft> StudyRuns::draft() const {
    if (state_->trialCost.learning <= 0.0 || !state_->summaries.empty()) return std::nullopt;
    const auto evolution =
        workflow::fitEvolution(state_->settings.evolution, workflow::kDraftLearningTime, state_->trialCost);
    if (!evolution) return std::nullopt;
    return LearningDraft{*evolution,
                         workflow::learningTime(*evolution, evolution->generations, state_->trialCost)};
}

}  // namespace trapwright::session
