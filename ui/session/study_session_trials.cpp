#include "core/work/estimate.h"
#include "ui/session/study_session_state.h"

namespace trapwright::session {

namespace {

constexpr double kEstimateBudget = 0.5;  // [s]

QString noTrials() {
    return StudySession::tr("This individual has no such trials. Choose another one, or simulate it first.");
}

}  // namespace

/// What a thread needs to make trials again; `Deliver` is called in the GUI thread.
void StudySession::makeAgain(const QString& what, const work::TrialsRequest& request, unsigned threads,
                             Simulate simulate) {
    if (!state_->reader) {
        emit failed(what, QString::fromStdString(state_->cannotRead().message));
        return;
    }
    auto stored = work::findStoredTrials(*state_->reader, state_->settings, request);
    if (!stored || (stored->count == 0 && request.count == 0)) {
        emit failed(what, stored ? noTrials() : QString::fromStdString(stored.error().message));
        return;
    }
    if (stored->engine.empty())
        stored->engine = work::engineFor(state_->settings.simulation.engine, work::EngineUse::judging);
    if (!request.engine.empty()) stored->engine = request.engine;
    countSimulations(1);
    state_->simulating->post([this, what, request, threads, stored = std::move(*stored),
                              simulate = std::move(simulate), settings = state_->settings,
                              part = state_->part.part, control = state_->simulated] {
        auto deliver = [&]() -> base::Result<std::function<void()>> {
            if (control.cancelled()) return std::function<void()>();
            const auto batch = work::makeTrials(settings, part, request, stored);
            if (!batch) return batch.error();
            const auto engine = state_->environment.makeEngine(stored.engine, {threads, 0.0});
            if (!engine) return engine.error();
            return simulate({settings, *part, stored, *batch, **engine, control});
        }();
        tell(this, [this, what, control, deliver = std::move(deliver)] {
            countSimulations(-1);
            if (control.cancelled()) return;
            if (deliver) {
                (*deliver)();
            } else {
                emit failed(what, QString::fromStdString(deliver.error().message));
            }
        });
    });
}

void StudySession::simulateTrials(const work::TrialsRequest& request) {
    makeAgain(
        tr("The trials could not be simulated"), request, state_->threads,
        [this, request](const Simulation& simulation) -> base::Result<std::function<void()>> {
            auto outcomes = study::runTrials(simulation.engine, {&simulation.batch, 1}, simulation.control);
            if (!outcomes) return outcomes.error();
            SimulatedTrials trials;
            trials.request = request;
            trials.outcomes = std::move(outcomes->front());
            trials.judged =
                work::judgeTrials(trials.outcomes, simulation.part.symmetry, simulation.stored.expected,
                                  simulation.settings.validation.tolerance);
            return std::function([this, trials = std::move(trials)] { emit trialsSimulated(trials); });
        });
}

void StudySession::replay(const work::TrialsRequest& request, int trial, double interval) {
    makeAgain(tr("The trial could not be replayed"), request, 1,
              [this, request, trial,
               interval](const Simulation& simulation) -> base::Result<std::function<void()>> {
                  if (trial < 0 || trial >= static_cast<int>(simulation.batch.trials.size()))
                      return base::Error{noTrials().toStdString()};
                  auto replay = simulation.engine.replay(simulation.batch, static_cast<std::size_t>(trial),
                                                         interval, simulation.control);
                  if (!replay) return replay.error();
                  const auto trajectory = std::make_shared<const trial::Trajectory>(std::move(*replay));
                  return std::function(
                      [this, request, trial, trajectory] { emit replayed(request, trial, trajectory); });
              });
}

void StudySession::cancelSimulations() {
    state_->simulated.cancel();
    state_->simulated = base::RunControl();
}

void StudySession::countSimulations(int change) {
    state_->simulations += change;
    tellState();
}

void StudySession::requestEstimate() {
    state_->estimate.cancel();
    if (state_->run || !state_->problems.empty()) return;
    state_->estimate = base::RunControl();
    state_->simulating->post([this, control = state_->estimate, settings = state_->settings,
                              part = state_->part.part, threads = state_->threads,
                              done = static_cast<int>(state_->summaries.size())] {
        if (control.cancelled()) return;
        const auto inputs =
            State::makeInputs(state_->environment, settings, part, work::EngineUse::learning, threads);
        if (!inputs) return;
        const auto seconds = work::estimateLearning(*inputs, kEstimateBudget, control);
        if (!seconds) return;
        const int generations = settings.evolution.generations;
        const double left = *seconds * std::max(generations - done, 0) / generations;
        tell(this, [this, control, left] {
            if (control.cancelled()) return;
            state_->estimatedSeconds = left;
            emit estimated(left);
        });
    });
}

double StudySession::estimatedSeconds() const {
    return state_->estimatedSeconds;
}

}  // namespace trapwright::session
