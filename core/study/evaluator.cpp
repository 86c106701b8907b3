#include "core/study/evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include "core/base/parallel.h"
#include "core/geometry/self_overlap.h"
#include "core/objectives/success_share.h"
#include "core/search/pareto.h"
#include "core/search/racing.h"
#include "core/search/ranking.h"
#include "core/study/stream.h"
#include "core/study/target.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"

namespace trapwright::study {

namespace {

/// An individual on its way to a record.
struct Candidate {
    std::shared_ptr<const track::Track> track;
    bool simulated = false;
    std::vector<trial::Outcome> outcomes;  // so far
    std::vector<trial::BoxPlace> places;   // of these trials; empty: all alike
    std::optional<stats::Count> streams;   // that were sent over it
    IndividualRecord record;
    std::string failure;
};

Candidate prepare(const StudyInputs& inputs, const search::Proposal& proposal,
                  const objectives::ObjectiveList& summed) {
    const Settings& settings = inputs.settings;
    Candidate candidate;
    candidate.record.design = proposal.design;
    candidate.record.traits = proposal.traits;
    auto track = decodeTrack(settings.track, proposal.design);
    if (!track) {
        candidate.failure = track.error().message;
        return candidate;
    }
    candidate.track = std::make_shared<const track::Track>(std::move(track).value());
    candidate.record.overlaps =
        geometry::countOverlappingTriangles(candidate.track->solid, candidate.track->surfaceTriangles);
    candidate.simulated = candidate.record.overlaps == 0 || settings.evolution.simulateOverlapping;
    if (!candidate.simulated) {
        candidate.record.fitness = objectives::measureSum(
            makeEvaluation(inputs, *candidate.track, candidate.record.overlaps, {}), summed);
    }
    return candidate;
}

void countEndings(std::span<const trial::Outcome> outcomes, IndividualRecord& record) {
    record.trials += static_cast<int>(outcomes.size());
    for (const trial::Outcome& outcome : outcomes) {
        for (const trial::PartOutcome& part : outcome.parts) {
            if (part.ending == trial::Ending::finished) {
                ++record.finished;
            } else if (part.ending == trial::Ending::fellOff) {
                ++record.fellOff;
            } else {
                ++record.stuck;
            }
        }
    }
}

base::Error brokenEngine(const trial::Engine& engine, const std::string& what) {
    return {"The engine " + engine.name() + " " + what +
            ". This is a fault of the engine; choose another one."};
}

/// The race of a generation's individuals; without racing a race of one round.
class Race {
 public:
    Race(const StudyInputs& inputs, int generation, std::vector<Candidate>& candidates)
        : inputs_(&inputs),
          generation_(generation),
          candidates_(&candidates),
          specimens_(makeSpecimens(inputs.settings, inputs.part)),
          summed_(summedObjectives(inputs.settings.evolution)),
          stages_(search::makeRacingStages(candidates.size(), settings().racingTrials,
                                           settings().trialsPerEvaluation, settings().racingShare)),
          running_(static_cast<int>(
              std::count_if(candidates.begin(), candidates.end(),
                            [](const Candidate& candidate) { return candidate.simulated; }))) {}

    /// Who runs next; empty when all is decided.
    [[nodiscard]] std::vector<search::RacingStep> findNextRound() const {
        return search::findNextRound(rank(), countTrials(), stages_);
    }

    [[nodiscard]] GenerationPlan plan(std::span<const search::RacingStep> round,
                                      std::int64_t doneBefore) const {
        std::vector<int> trials = countTrials();
        for (const search::RacingStep& step : round)
            trials[step.individual] = step.trials;
        const int streams = std::min(running_, countStreamed(settings())) * settings().streamsEach;
        return {generation_, static_cast<int>(candidates_->size()), running_,
                search::countRacingTrials(trials, running_, stages_) + streams, doneBefore};
    }

    base::Status run(std::span<const search::RacingStep> round, const base::RunControl& control) {
        std::vector<trial::TrialBatch> batches(round.size());
        base::parallelFor(round.size(), inputs_->threads, [&](std::size_t i, unsigned /*worker*/) {
            const Candidate& candidate = (*candidates_)[round[i].individual];
            const int first = candidate.record.trials;
            batches[i] = makeLearningBatch(makeScene(inputs_->settings, specimens_, candidate.track),
                                           {generation_, static_cast<int>(round[i].individual)},
                                           round[i].trials - first, first);
        });
        auto outcomes = runTrials(*inputs_->engine, batches, control);
        if (!outcomes) return outcomes.error();
        // Eq. 5 goes over all pairs, so this is worth the threads, too.
        base::parallelFor(round.size(), inputs_->threads, [&](std::size_t i, unsigned /*worker*/) {
            Candidate& candidate = (*candidates_)[round[i].individual];
            const std::vector<trial::BoxPlace> places = listPlaces(batches[i]);
            candidate.places.insert(candidate.places.end(), places.begin(), places.end());
            score((*outcomes)[i], candidate);
        });
        return base::success();
    }

    /// Over the best that have all trials.
    base::Status sendStreams(const base::RunControl& control) {
        std::vector<std::size_t> sent;
        for (const std::size_t i : search::rankByFitness(rank())) {
            const Candidate& candidate = (*candidates_)[i];
            if (static_cast<int>(sent.size()) == countStreamed(settings())) break;
            if (candidate.simulated && candidate.record.trials == settings().trialsPerEvaluation)
                sent.push_back(i);
        }
        if (sent.empty()) return base::success();
        std::vector<trial::TrialBatch> batches(sent.size());
        base::parallelFor(sent.size(), inputs_->threads, [&](std::size_t i, unsigned /*worker*/) {
            batches[i] = makeLearningStreams(inputs_->settings, specimens_, (*candidates_)[sent[i]].track,
                                             generation_);
        });
        const auto outcomes = runTrials(*inputs_->engine, batches, control);
        if (!outcomes) return outcomes.error();
        for (std::size_t i = 0; i < sent.size(); ++i) {
            Candidate& candidate = (*candidates_)[sent[i]];
            const objectives::Evaluation evaluation = evaluate(candidate);
            const trial::Goal goal = trial::findGoal(evaluation.wanted, candidate.outcomes,
                                                     *evaluation.symmetry, evaluation.tolerance);
            candidate.streams = countThroughput(inputs_->settings.stream, goal, *evaluation.symmetry,
                                                evaluation.tolerance, batches[i], (*outcomes)[i]);
            candidate.record.fitness = objectives::measureSum(evaluate(candidate), summed_);
        }
        return base::success();
    }

    [[nodiscard]] objectives::Evaluation evaluate(const Candidate& candidate) const {
        objectives::Evaluation evaluation = makeEvaluation(
            *inputs_, *candidate.track, candidate.record.overlaps, candidate.outcomes, candidate.places);
        evaluation.streams = candidate.streams;
        return evaluation;
    }

 private:
    [[nodiscard]] const EvolutionSettings& settings() const { return inputs_->settings.evolution; }

    /// rankingScores of all by their trials so far; who has none yet is as good as any.
    [[nodiscard]] std::vector<double> rank() const {
        std::vector<objectives::Fitness> fitnesses;
        fitnesses.reserve(candidates_->size());
        bool isScored = true;
        for (const Candidate& candidate : *candidates_) {
            fitnesses.push_back(candidate.record.fitness);
            isScored = isScored && !candidate.record.fitness.scores.empty();
        }
        if (!isScored) return std::vector<double>(candidates_->size(), 0.0);
        return rankingScores(settings(), fitnesses);
    }

    [[nodiscard]] std::vector<int> countTrials() const {
        std::vector<int> trials;
        for (const Candidate& candidate : *candidates_)
            trials.push_back(candidate.simulated ? candidate.record.trials : settings().trialsPerEvaluation);
        return trials;
    }

    void score(std::span<const trial::Outcome> more, Candidate& candidate) const {
        candidate.outcomes.insert(candidate.outcomes.end(), more.begin(), more.end());
        countEndings(more, candidate.record);
        candidate.record.fitness = objectives::measureSum(evaluate(candidate), summed_);
    }

    const StudyInputs* inputs_;
    int generation_;
    std::vector<Candidate>* candidates_;
    Specimens specimens_;
    objectives::ObjectiveList summed_;
    std::vector<search::RacingStage> stages_;
    int running_;
};

}  // namespace

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
    if (plan.trials > 0 && plan.planningFor == 0)
        progress.individualsDone += static_cast<int>(here * plan.simulated / plan.trials);
    if (done <= 0 || seconds <= 0.0) return progress;
    progress.trialsPerSecond = static_cast<double>(done) / seconds;
    const bool isPlanning = plan.planningFor > 0;
    const std::int64_t generationsLeft = std::max(generations - plan.generation - (isPlanning ? 0 : 1), 0);
    const std::int64_t trialsLeft =
        plan.trials - here + generationsLeft * (isPlanning ? plan.planningFor : plan.trials);
    progress.secondsLeft = static_cast<double>(trialsLeft) / progress.trialsPerSecond;
    return progress;
}

objectives::ObjectiveList summedObjectives(const EvolutionSettings& settings) {
    auto list = objectives::readObjectives(settings.objectives);
    assert(list.ok());
    return std::move(list).value();
}

objectives::ObjectiveList tradedObjectives(const EvolutionSettings& settings) {
    if (settings.tradeOff.empty() || !findTradeOffProblem(settings).empty()) return {};
    return objectives::readObjectives(settings.tradeOff).value();
}

std::string findTradeOffProblem(const EvolutionSettings& settings) {
    const auto summed = objectives::readObjectives(settings.objectives);
    if (settings.tradeOff.empty() || !summed) return {};
    const std::string subject = fmt::format("evolution.tradeOff is \"{}\". ", settings.tradeOff);
    const auto traded = objectives::readObjectives(settings.tradeOff);
    if (!traded) return subject + traded.error().message;
    if (traded->size() != 2)
        return subject + "Name the two objectives that are traded for each other, or none.";
    for (const objectives::Objective* objective : *traded) {
        if (!objectives::contains(*summed, objective->key))
            return subject + fmt::format("{} is not among evolution.objectives, which are {}; add it there.",
                                         objective->key, settings.objectives);
    }
    return {};
}

std::vector<double> rankingScores(const EvolutionSettings& settings,
                                  std::span<const objectives::Fitness> fitnesses) {
    std::vector<double> scores(fitnesses.size());
    const objectives::ObjectiveList traded = tradedObjectives(settings);
    if (traded.empty()) {
        std::ranges::transform(fitnesses, scores.begin(), &objectives::Fitness::total);
        return scores;
    }
    std::array<objectives::ObjectiveList, 2> sums;
    for (std::size_t k = 0; k < 2; ++k) {
        sums[k] = summedObjectives(settings);
        std::erase(sums[k], traded[1 - k]);
    }
    std::vector<search::TwoScores> points;
    points.reserve(fitnesses.size());
    for (const objectives::Fitness& fitness : fitnesses)
        points.push_back(
            {objectives::calcTotal(fitness.scores, sums[0]), objectives::calcTotal(fitness.scores, sums[1])});
    double place = 0.0;
    for (const std::size_t i : search::rankByFronts(points))
        scores[i] = -place++;
    return scores;
}

int countStreamed(const EvolutionSettings& settings) {
    return objectives::contains(summedObjectives(settings), objectives::kThroughput)
               ? search::countShare(static_cast<std::size_t>(settings.populationSize), settings.streamShare)
               : 0;
}

objectives::Evaluation makeEvaluation(const StudyInputs& inputs, const track::Track& track, int overlaps,
                                      std::span<const trial::Outcome> outcomes,
                                      std::span<const trial::BoxPlace> places) {
    objectives::Evaluation evaluation;
    evaluation.places = places;
    // What was not simulated was not in learning.
    evaluation.isVaried = !places.empty() || (outcomes.empty() && inputs.settings.evolution.conditions ==
                                                                      TrialConditions::varied);
    evaluation.hasCorners = outcomes.empty()
                                ? evaluation.isVaried && cornerShareIn(inputs.settings.evolution, 0) > 0.0
                                : std::ranges::any_of(places, trial::isCorner);
    evaluation.track = &track;
    evaluation.symmetry = &inputs.part->symmetry;
    evaluation.overlaps = overlaps;
    evaluation.outcomes = outcomes;
    evaluation.distance = inputs.settings.evolution.orientationDistance;
    evaluation.tolerance = inputs.settings.validation.tolerance;
    evaluation.wanted = findWanted(inputs.settings, *inputs.part);
    evaluation.returns = inputs.settings.track.returns;
    return evaluation;
}

base::Status checkInputs(const StudyInputs& inputs) {
    std::string problems;
    for (const std::string& problem : findProblems(inputs.settings))
        problems += "\n" + problem;
    for (const std::string& problem : findPartProblems(inputs.settings, *inputs.part))
        problems += "\n" + problem;
    if (problems.empty()) return base::success();
    return base::Error{"The settings cannot be used:" + problems};
}

base::Result<std::vector<std::vector<trial::Outcome>>> runTrials(const trial::Engine& engine,
                                                                 std::span<const trial::TrialBatch> batches,
                                                                 base::RunControl control) {
    auto outcomes = engine.run(batches, std::move(control));
    if (!outcomes) return outcomes;
    if (outcomes->size() != batches.size()) return brokenEngine(engine, "left out a whole batch of trials");
    for (std::size_t b = 0; b < batches.size(); ++b) {
        if ((*outcomes)[b].size() != batches[b].trials.size()) return brokenEngine(engine, "left out trials");
        for (std::size_t i = 0; i < batches[b].trials.size(); ++i) {
            const std::vector<trial::PartOutcome>& parts = (*outcomes)[b][i].parts;
            if (parts.size() != batches[b].trials[i].parts.size())
                return brokenEngine(engine, "left out parts");
            if (trial::isFinite((*outcomes)[b][i])) continue;
            const base::StreamKey& stream = batches[b].trials[i].stream;
            return brokenEngine(engine, "lost the part in trial " + std::to_string(stream.trial) +
                                            " of individual " + std::to_string(stream.individual) +
                                            " of generation " + std::to_string(stream.generation) +
                                            ": its pose is not a number");
        }
    }
    return outcomes;
}

trial::OutcomeMaker makerOf(const trial::Engine& engine) {
    return {"", engine.name(), engine.instructionSet()};
}

base::Result<JudgedGeneration> evaluateGeneration(const StudyInputs& inputs, int generation,
                                                  std::span<const search::Proposal> proposals,
                                                  const std::function<void(const GenerationPlan&)>& planned,
                                                  base::RunControl control) {
    const objectives::ObjectiveList summed = summedObjectives(inputs.settings.evolution);
    std::vector<Candidate> candidates(proposals.size());
    base::parallelFor(proposals.size(), inputs.threads, [&](std::size_t i, unsigned /*worker*/) {
        if (control.mayGoOn()) candidates[i] = prepare(inputs, proposals[i], summed);
    });
    if (control.cancelled()) return base::Error{"The evaluation was cancelled."};
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (candidates[i].failure.empty()) continue;
        return base::Error{"The track of individual " + std::to_string(i) + " of generation " +
                           std::to_string(generation) + " cannot be built: " + candidates[i].failure};
    }

    Race race(inputs, generation, candidates);
    const std::int64_t doneBefore = control.done();
    auto round = race.findNextRound();
    do {
        if (planned) planned(race.plan(round, doneBefore));
        if (const auto ran = race.run(round, control); !ran) return ran.error();
        round = race.findNextRound();
    } while (!round.empty());
    if (const auto sent = race.sendStreams(control); !sent) return sent.error();

    // Nothing of learning looks at success and what else does not count in F, so it is measured once, when
    // all trials are known.
    base::parallelFor(candidates.size(), inputs.threads, [&](std::size_t i, unsigned /*worker*/) {
        Candidate& candidate = candidates[i];
        objectives::Evaluation evaluation = race.evaluate(candidate);
        candidate.record.oriented = objectives::countSuccess(evaluation);
        evaluation.oriented = candidate.record.oriented;
        candidate.record.fitness = objectives::measureOthers(evaluation, candidate.record.fitness);
    });

    JudgedGeneration judged;
    judged.individuals.reserve(candidates.size());
    for (Candidate& candidate : candidates) {
        judged.individuals.push_back(std::move(candidate.record));
        judged.outcomes.insert(judged.outcomes.end(), candidate.outcomes.begin(), candidate.outcomes.end());
    }
    return judged;
}

}  // namespace trapwright::study
