#include "core/study/reference_check.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/study/final_orientation.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"

namespace trapwright::study {

namespace {

EngineScore scoreOf(const StudyInputs& inputs, const trial::Engine& engine, const track::Track& track,
                    std::span<const trial::Outcome> outcomes, int overlaps,
                    const base::Quaternion& expected) {
    EngineScore score;
    score.engine = engine.name();
    score.fitness = trial::calcFitness(track, outcomes, overlaps, inputs.part->symmetry,
                                       inputs.settings.evolution.orientationDistance);
    score.finished = static_cast<int>(finalOrientations(outcomes).size());
    score.oriented =
        countOriented(outcomes, expected, inputs.part->symmetry, inputs.settings.validation.tolerance);
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
    const std::array batches = {makeLearningBatch(makeScene(inputs.settings, inputs.part, track),
                                                  winner.generation, winner.individual,
                                                  countCheckTrials(winner))};
    const auto learned = runTrials(*inputs.engine, batches, control);
    if (!learned) return learned.error();
    const auto judged = runTrials(reference, batches, control);
    if (!judged) return judged.error();

    const std::vector<trial::Outcome>& own = learned->front();
    const base::Quaternion expected = trial::findModalOrientation(
        finalOrientations(own), inputs.part->symmetry, inputs.settings.validation.tolerance);
    const int overlaps = winner.record.overlaps;
    CheckRecord record;
    record.generation = winner.generation;
    record.individual = winner.individual;
    record.trials = static_cast<int>(own.size());
    record.learning = scoreOf(inputs, *inputs.engine, *track, own, overlaps, expected);
    record.reference = scoreOf(inputs, reference, *track, judged->front(), overlaps, expected);
    return record;
}

}  // namespace trapwright::study
