#include "core/study/reference_check.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "core/base/parallel.h"
#include "core/study/target.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

namespace {

EngineScore scoreOf(const StudyInputs& inputs, const trial::Engine& engine, const track::Track& track,
                    std::span<const trial::Outcome> outcomes, std::span<const trial::BoxPlace> places,
                    int overlaps, const trial::Goal& goal) {
    EngineScore score;
    score.engine = engine.name();
    score.finished = static_cast<int>(trial::finalOrientations(outcomes).size());
    score.oriented =
        trial::tally(outcomes, goal, inputs.part->symmetry, inputs.settings.validation.tolerance).success;
    objectives::Evaluation evaluation = makeEvaluation(inputs, track, overlaps, outcomes, places);
    evaluation.oriented = score.oriented;
    score.fitness = objectives::measureAll(evaluation, summedObjectives(inputs.settings.evolution));
    return score;
}

}  // namespace

int countCheckTrials(const Individual& winner) {
    return std::min(winner.record.trials, kCheckTrials);
}

base::Result<CheckRecord> checkWinner(const StudyInputs& inputs, const trial::Engine& reference,
                                      const Individual& winner, const base::RunControl& control) {
    assert(winner.record.trials > 0);
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    auto built = decodeTrack(inputs.settings.track, winner.record.design);
    if (!built) return built.error();
    const auto track = std::make_shared<const track::Track>(std::move(built).value());
    std::array batches = {
        makeLearningBatch(makeScene(inputs.settings, inputs.part, track), winner, countCheckTrials(winner))};
    const auto learned = runTrials(*inputs.engine, batches, control);
    if (!learned) return learned.error();
    // The reference in its own step, so that a step that was too large shows.
    batches.front().step = 0.0;
    const auto judged = runTrials(reference, batches, control);
    if (!judged) return judged.error();

    const std::vector<trial::Outcome>& own = learned->front();
    const trial::Goal goal = trial::findGoal(findWanted(inputs.settings, *inputs.part), own,
                                             inputs.part->symmetry, inputs.settings.validation.tolerance);
    const int overlaps = winner.record.overlaps;
    const std::vector<trial::BoxPlace> places = listPlaces(batches.front());
    CheckRecord record;
    record.generation = winner.generation;
    record.individual = winner.individual;
    record.trials = static_cast<int>(own.size());
    record.learning = scoreOf(inputs, *inputs.engine, *track, own, places, overlaps, goal);
    record.reference = scoreOf(inputs, reference, *track, judged->front(), places, overlaps, goal);
    return record;
}

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
