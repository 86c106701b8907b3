#include "core/study/track_trials.h"

#include "core/study/trial_batches.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

trial::TrialBatch makeTrackBatch(std::shared_ptr<const track::Track> track,
                                 std::shared_ptr<const part::Part> part, const SimulationSettings& simulation,
                                 std::uint64_t seed, int trials) {
    return makeLearningBatch({&simulation, std::move(part), std::move(track), seed}, {0, 0}, trials);
}

TrialCounts countTrials(std::span<const trial::Outcome> outcomes, const part::SymmetryGroup& symmetry,
                        const std::optional<base::Quaternion>& expected, double tolerance) {
    TrialCounts counts;
    counts.expected =
        expected ? *expected
                 : trial::findModalOrientation(trial::finalOrientations(outcomes), symmetry, tolerance);
    counts.tally = trial::tally(outcomes, counts.expected, symmetry, tolerance);
    for (const trial::Outcome& outcome : outcomes) {
        for (const trial::PartOutcome& part : outcome.parts)
            counts.simulatedTime += part.time;
    }
    return counts;
}

}  // namespace trapwright::study
