#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/records.h"
#include "core/study/settings.h"
#include "core/trial/engine.h"

namespace trapwright::study {

/// What one generation is going to cost, known once its tracks are built; of a race an estimate, made anew
/// for each round.
struct GenerationPlan {
    int generation = 0;
    int individuals = 0;          // the population
    int simulated = 0;            // of them; the others' surfaces overlap themselves
    std::int64_t trials = 0;      // of all together
    std::int64_t doneBefore = 0;  // RunControl::done() before its first trial
    /// That chains are planned with, before there is a generation (planDesigns); none of its individuals is
    /// done then. How many trials each generation is expected to take that follows; 0: this is a generation.
    std::int64_t planningFor = 0;
    /// Of the parts that come to the traps those that lie as it is wanted before anything turns them; none:
    /// nothing is wanted, or it is not known, as where nothing is planned.
    std::optional<double> wantedUnturned{};
};

/// A copyable handle on a learning run: any copy may stop it, from any thread and from a signal handler.
class LearningControl {
 public:
    /// Ends the run as soon as the engine can stop; the unfinished generation is dropped. Counts the trials.
    base::RunControl run;
    /// Of what goes on beside the run: checks of winners. Counts their trials.
    base::RunControl checks;

    /// Has run and checks stand still.
    void pause();
    void resume();

    /// Ends the run when the present generation is saved.
    void stopAfterGeneration() { stop_->store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool stopRequested() const { return stop_->load(std::memory_order_relaxed); }

    /// Has the run end after this many generations in all, whatever its settings say.
    void setGenerations(int count) { generations_->store(count, std::memory_order_relaxed); }
    /// That number, or `fallback` where none was set.
    [[nodiscard]] int generationsOr(int fallback) const;

 private:
    std::shared_ptr<std::atomic<bool>> stop_ = std::make_shared<std::atomic<bool>>(false);
    std::shared_ptr<std::atomic<int>> generations_ = std::make_shared<std::atomic<int>>(0);
};

/// How far a learning run has come.
struct LearningProgress {
    int individualsDone = 0;       // of the present generation
    double trialsPerSecond = 0.0;  // since the run began
    double secondsLeft =
        0.0;  // until the last generation, if the others cost as much as this; 0 while unknown
};

/// `done`: trials since the run began (RunControl::done() less its value then); `seconds`: time since then.
LearningProgress estimateProgress(const GenerationPlan& plan, int generations, std::int64_t done,
                                  double seconds);

/// What learning, selection and validation work with. The results depend on settings and part, and on the
/// engine's; not on the number of threads.
struct StudyInputs {
    Settings settings;
    std::shared_ptr<const part::Part> part;
    std::shared_ptr<const trial::Engine> engine;
    unsigned threads = 1;  // for building tracks; the engine has its own
    /// Trials that the engines of this run could not finish; null: nobody asks.
    std::shared_ptr<trial::RemadeTrials> remade = nullptr;
    KnownTracks known{};  // of the first generation; workflow::learn finds them
};

/// What counts in F. The settings must be without problems (findProblems).
objectives::ObjectiveList summedObjectives(const EvolutionSettings& settings);

/// The two objectives of the sum that are traded for each other. Empty: none are, or the settings have a
/// problem (findTradeOffProblem).
objectives::ObjectiveList tradedObjectives(const EvolutionSettings& settings);
/// What is wrong with EvolutionSettings::tradeOff; empty: nothing.
std::string findTradeOffProblem(const EvolutionSettings& settings);

/// By what a search ranks tracks, the more the better: F, or where two objectives are traded the place among
/// all, 0 for the best, then -1, ... in the order of search::rankByFronts. Each of the two goes with all else
/// that counts, so that one score is F without the one, and one F without the other.
std::vector<double> rankingScores(const EvolutionSettings& settings,
                                  std::span<const objectives::Fitness> fitnesses);

/// How many of a generation streams of parts are sent over: none unless the objective throughput counts.
int countStreamed(const EvolutionSettings& settings);

/// These outcomes on this track as objectives look at them, with the trials' places in the operating box
/// (listPlaces). All must outlive the evaluation.
objectives::Evaluation makeEvaluation(const StudyInputs& inputs, const track::Track& track, int overlaps,
                                      std::span<const trial::Outcome> outcomes,
                                      std::span<const trial::BoxPlace> places = {});

/// An error that lists everything that is wrong with settings and part, if anything is.
base::Status checkInputs(const StudyInputs& inputs);

/// Simulates the batches. An error of the engine, also if it breaks its contract: a wrong number of outcomes,
/// a pose that is not finite.
base::Result<std::vector<std::vector<trial::Outcome>>> runTrials(const trial::Engine& engine,
                                                                 std::span<const trial::TrialBatch> batches,
                                                                 base::RunControl control);

/// What makes outcomes here; the program is told by whoever stores them.
trial::OutcomeMaker makerOf(const trial::Engine& engine);

/// The individuals of a generation, and their trials one individual after the other.
struct JudgedGeneration {
    std::vector<IndividualRecord> individuals;
    std::vector<trial::Outcome> outcomes;
};

/// Judges every proposal of a generation (paper, section 3, step 2a): its track is built, overlapping
/// triangles are counted, and all trials of all individuals go to the engine at once; in a race, those of
/// each round (core/search/racing.h). A track that overlaps itself is not simulated unless the settings
/// want it. Where throughput counts, streams of parts are then sent over the best tracks. `planned` is called
/// before the trials, in a race before those of each round. An error if cancelled.
base::Result<JudgedGeneration> evaluateGeneration(const StudyInputs& inputs, int generation,
                                                  std::span<const search::Proposal> proposals,
                                                  const std::function<void(const GenerationPlan&)>& planned,
                                                  base::RunControl control);

}  // namespace trapwright::study
