#pragma once

#include <memory>

#include "core/study/settings.h"
#include "core/trial/batch.h"

namespace trapwright::study {

/// What every trial of a study has in common.
struct TrialScene {
    const SimulationSettings* simulation = nullptr;
    std::shared_ptr<const part::Part> part;
    std::shared_ptr<const track::Track> track;
    std::uint64_t seed = 0;  // of the study
};

/// Each trial's start is drawn from its own stream (seed, generation, individual, trial, purpose), so that
/// any single trial can be made again from the study alone. Each of these makes the batch anew with the same
/// bits.

/// The trials by which an individual is judged while learning.
trial::TrialBatch makeLearningBatch(const TrialScene& scene, int generation, int individual, int trials);

/// Fresh trials of a winner (paper, section 6.1.1).
trial::TrialBatch makeSelectionBatch(const TrialScene& scene, int generation, int individual, int trials);

/// Trials that start near one of the part's stable poses (paper, section 6.2; decision 11). Trial i of pose p
/// is trial p x trials + i of the stream.
trial::TrialBatch makeValidationBatch(const TrialScene& scene, int generation, int individual, int pose,
                                      int trials);

}  // namespace trapwright::study
