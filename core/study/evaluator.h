#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/study/learning_control.h"
#include "core/study/records.h"
#include "core/study/settings.h"
#include "core/trial/engine.h"

namespace trapwright::study {

/// What learning, selection and validation work with. The results depend on settings and part, and on the
/// engine's; not on the number of threads.
struct StudyInputs {
    Settings settings;
    std::shared_ptr<const part::Part> part;
    std::shared_ptr<const trial::Engine> engine;
    unsigned threads = 1;  // for building tracks; the engine has its own
};

/// What counts in F. The settings must be without problems (findProblems).
objectives::ObjectiveList summedObjectives(const EvolutionSettings& settings);

/// These outcomes on this track as objectives look at them. All must outlive the evaluation.
objectives::Evaluation makeEvaluation(const StudyInputs& inputs, const track::Track& track, int overlaps,
                                      std::span<const trial::Outcome> outcomes);

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
/// want it. `planned` is called before the trials, in a race before those of each round. An error if
/// cancelled.
base::Result<JudgedGeneration> evaluateGeneration(const StudyInputs& inputs, int generation,
                                                  std::span<const search::Proposal> proposals,
                                                  const std::function<void(const GenerationPlan&)>& planned,
                                                  base::RunControl control);

}  // namespace trapwright::study
