#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/study/settings.h"
#include "core/trial/batch.h"
#include "core/trial/orientations.h"
#include "core/trial/outcome.h"

namespace trapwright::study {

/// How the trials of one part on one track ended.
struct TrialCounts {
    trial::Tally tally;
    double simulatedTime = 0.0;  // of all together [s]
    base::Quaternion expected = base::Quaternion::Identity();
};

/// Trials from random starts on a track that is of no study.
trial::TrialBatch makeTrackBatch(std::shared_ptr<const track::Track> track,
                                 std::shared_ptr<const part::Part> part, const SimulationSettings& simulation,
                                 std::uint64_t seed, int trials);

/// `expected`: the orientation that counts; without it the most frequent final one. `tolerance` [rad].
TrialCounts countTrials(std::span<const trial::Outcome> outcomes, const part::SymmetryGroup& symmetry,
                        const std::optional<base::Quaternion>& expected, double tolerance);

}  // namespace trapwright::study
