#pragma once

#include <memory>
#include <optional>

#include "core/study/individual_id.h"
#include "core/study/settings.h"
#include "core/trial/batch.h"

namespace trapwright::study {

/// What every trial on one track of a study has in common.
struct TrialScene {
    const SimulationSettings* simulation = nullptr;
    std::shared_ptr<const part::Part> part;
    std::shared_ptr<const track::Track> track;
    std::uint64_t seed = 0;            // of the study
    bool commonRandomNumbers = false;  // see makeLearningBatch
    std::optional<double> learningStuckTime =
        std::nullopt;  // of makeLearningBatch, if less than the simulation's [s]
};

/// The scene of a track of the study. Refers to `settings`.
TrialScene makeScene(const Settings& settings, std::shared_ptr<const part::Part> part,
                     std::shared_ptr<const track::Track> track);

/// Each trial's start is drawn from its own stream (seed, generation, individual, trial, purpose), so that
/// any single trial can be made again from the study alone. Each of these makes the batch anew with the same
/// bits.

/// The trials by which an individual is judged while learning: `trials` of them from `first` on. With common
/// random numbers all individuals of a generation have the streams of individual 0, so that each meets the
/// same starts and a difference of two scores has less noise. What does not move on is given up sooner than
/// elsewhere (EvolutionSettings::learningStuckTime).
trial::TrialBatch makeLearningBatch(const TrialScene& scene, const IndividualId& individual, int trials,
                                    int first = 0);

/// Fresh trials of a winner (paper, section 6.1.1).
trial::TrialBatch makeSelectionBatch(const TrialScene& scene, const IndividualId& individual, int trials);

/// Trials that start near one of the part's stable poses (paper, section 6.2;
/// decisions.md#selection-and-success). Trial i of pose p is trial p x trials + i of the stream.
trial::TrialBatch makeValidationBatch(const TrialScene& scene, const IndividualId& individual, int pose,
                                      int trials);

}  // namespace trapwright::study
