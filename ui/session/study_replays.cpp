#include "ui/session/study_replays.h"

#include <algorithm>

#include "core/study/evaluator.h"
#include "core/study/target.h"
#include "core/study/trial_batches.h"
#include "ui/session/study_state.h"

namespace trapwright::session {

namespace {

// Before others have their turn.
constexpr int kAtOnce = 60;        // trials
constexpr int kStreamsAtOnce = 2;  // each lasts a minute, with many parts

QString noTrials() {
    return StudyReplays::tr("This individual has no such trials. Choose another one, or simulate it first.");
}

QString trialsFailed() {
    return StudyReplays::tr("The trials could not be simulated");
}

bool isSame(const workflow::TrialsRequest& a, const workflow::TrialsRequest& b) {
    return a.kind == b.kind && a.poses == b.poses && a.count == b.count && a.engine == b.engine &&
           a.robustness == b.robustness && a.stream == b.stream && isSameIndividual(a.winner, b.winner) &&
           a.winner.record == b.winner.record;
}

void judge(const workflow::StoredTrials& stored, const part::Part& part, const study::Settings& settings,
           ListedTrials& trials) {
    trials.judged = workflow::judgeTrials(trials.outcomes, part.symmetry,
                                          stored.goal ? stored.goal : study::findWanted(settings, part),
                                          settings.validation.tolerance);
}

}  // namespace

/// Trials that are listed or made again. Values that any thread may read.
struct StudyReplays::Simulation {
    study::Settings settings;
    std::shared_ptr<const part::Part> part;
    std::shared_ptr<const workflow::StoredTrials> stored;
    trial::TrialBatch batch;
    std::optional<trial::MadeOutcomes> kept;  // in the study, of all trials of the batch
    std::shared_ptr<const trial::Engine> engine;
    trial::OutcomeMaker maker;  // of what is simulated now
    base::RunControl control;
};

StudyReplays::StudyReplays(StudyState& state, const StudyRuns& runs) : state_(&state), runs_(runs) {}

/// What the study holds of these trials. Many of the same are replayed one after the other, and need not be
/// read each time.
base::Result<std::shared_ptr<const workflow::StoredTrials>> StudyReplays::findTrials(
    const workflow::TrialsRequest& request) {
    if (state_->found && isSame(state_->found->request, request)) return state_->found->trials;
    auto stored =
        workflow::findStoredTrials(*state_->reader, state_->settings, state_->environment.engines, request);
    if (!stored) return stored.error();
    if (stored->engine.empty())
        stored->engine = state_->environment.engines.nameFor(state_->settings.simulation.engine,
                                                             trial::EngineUse::judging);
    if (!request.engine.empty()) stored->engine = request.engine;
    auto trials = std::make_shared<const workflow::StoredTrials>(std::move(*stored));
    state_->found = std::make_shared<const FoundTrials>(FoundTrials{request, trials});
    return trials;
}

/// Finds the trials and has `simulate` called on the thread that makes them again.
void StudyReplays::makeAgain(const QString& what, const workflow::TrialsRequest& request, unsigned threads,
                             Simulate simulate) {
    if (!state_->reader) {
        state_->fail(what, QString::fromStdString(state_->cannotRead().message));
        return;
    }
    const auto found = findTrials(request);
    if (!found || ((*found)->count == 0 && request.count == 0)) {
        state_->fail(what, found ? noTrials() : QString::fromStdString(found.error().message));
        return;
    }
    state_->postSimulation(
        what, state_->simulated,
        [this, request, threads, stored = *found, simulate = std::move(simulate), settings = state_->settings,
         part = state_->part.part, control = state_->simulated]() -> Deliver {
            auto batch = workflow::makeTrials(settings, part, request, *stored);
            if (!batch) return batch.error();
            auto kept = workflow::unpackTrials(*stored, *batch);
            if (!kept) return kept.error();
            auto engine = state_->environment.engines.make(stored->engine, {threads, 0.0});
            if (!engine) return engine.error();
            trial::OutcomeMaker maker = study::makerOf(**engine);
            maker.program = state_->environment.program;
            return simulate(std::make_shared<const Simulation>(
                Simulation{settings, part, stored, std::move(*batch), std::move(*kept), std::move(*engine),
                           maker, control}));
        });
}

void StudyReplays::requestTrials(const workflow::TrialsRequest& request) {
    makeAgain(trialsFailed(), request, state_->threads,
              [this, request](const std::shared_ptr<const Simulation>& simulation) {
                  ListedTrials trials;
                  trials.request = request;
                  trials.wanted = static_cast<int>(simulation->batch.trials.size());
                  trials.places = study::listPlaces(simulation->batch);
                  return simulation->kept ? listStored(*simulation, std::move(trials))
                                          : simulateSome(simulation, std::move(trials));
              });
}

void StudyReplays::requestSlices(const workflow::TrialsRequest& request) {
    const QString what = tr("The trials could not be told by their conditions");
    if (!state_->reader) {
        state_->fail(what, QString::fromStdString(state_->cannotRead().message));
        return;
    }
    auto stored =
        workflow::findStoredTrials(*state_->reader, state_->settings, state_->environment.engines, request);
    if (!stored) {
        state_->fail(what, QString::fromStdString(stored.error().message));
        return;
    }
    // Whoever goes on to other trials still wants these.
    state_->postSimulation(what, base::RunControl(),
                           [this, request, stored = std::move(*stored), settings = state_->settings,
                            part = state_->part.part]() -> Deliver {
                               auto conditions = workflow::sliceTrials(settings, part, request, stored);
                               if (!conditions) return conditions.error();
                               return std::function([this, request, conditions = std::move(*conditions)] {
                                   emit sliced(request, conditions);
                               });
                           });
}

StudyReplays::Deliver StudyReplays::listStored(const Simulation& simulation, ListedTrials trials) {
    trials.outcomes = simulation.kept->outcomes;
    trials.maker = simulation.kept->maker;
    trials.stored = true;
    judge(*simulation.stored, *simulation.part, simulation.settings, trials);
    return std::function([this, trials = std::move(trials)] { emit trialsListed(trials); });
}

/// Simulates the next trials after these, and posts those that are left.
StudyReplays::Deliver StudyReplays::simulateSome(const std::shared_ptr<const Simulation>& simulation,
                                                 ListedTrials trials) {
    trial::TrialBatch batch = simulation->batch;
    const auto first = static_cast<std::ptrdiff_t>(trials.outcomes.size());
    const int atOnce = trials.request.stream ? kStreamsAtOnce : kAtOnce;
    batch.trials.assign(
        simulation->batch.trials.begin() + first,
        simulation->batch.trials.begin() + std::min<std::ptrdiff_t>(first + atOnce, trials.wanted));
    const auto outcomes = study::runTrials(*simulation->engine, {&batch, 1}, simulation->control);
    if (!outcomes) return outcomes.error();
    trials.outcomes.insert(trials.outcomes.end(), outcomes->front().begin(), outcomes->front().end());
    trials.maker = simulation->maker;
    judge(*simulation->stored, *simulation->part, simulation->settings, trials);
    return std::function([this, simulation, trials = std::move(trials)] {
        if (static_cast<int>(trials.outcomes.size()) == trials.wanted) {
            emit trialsListed(trials);
            return;
        }
        emit trialsArrived(trials);
        // Who was told may have had enough.
        if (simulation->control.cancelled()) return;
        state_->postSimulation(trialsFailed(), simulation->control,
                               [this, simulation, trials] { return simulateSome(simulation, trials); });
    });
}

void StudyReplays::replay(const workflow::TrialsRequest& request, int trial, double interval) {
    makeAgain(
        tr("The trial could not be replayed"), request, 1,
        [this, request, trial, interval](const std::shared_ptr<const Simulation>& simulation) -> Deliver {
            if (trial < 0 || trial >= static_cast<int>(simulation->batch.trials.size()))
                return base::Error{noTrials().toStdString()};
            auto replay = simulation->engine->replay(simulation->batch, static_cast<std::size_t>(trial),
                                                     interval, simulation->control);
            if (!replay) return replay.error();
            const auto trajectory = std::make_shared<const trial::Trajectory>(std::move(*replay));
            std::optional<workflow::OutcomeDifference> difference;
            if (const auto& kept = simulation->kept)
                difference = workflow::findDifference(kept->outcomes[static_cast<std::size_t>(trial)],
                                                      kept->maker, trajectory->outcome, simulation->maker);
            return std::function([this, request, trial, trajectory, difference] {
                emit replayed(request, trial, trajectory, difference);
            });
        });
}

void StudyReplays::cancelSimulations() {
    state_->simulated.cancel();
    state_->simulated = base::RunControl();
}

}  // namespace trapwright::session
