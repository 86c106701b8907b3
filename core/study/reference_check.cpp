#include "core/study/reference_check.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

namespace {

EngineScore scoreOf(const StudyInputs& inputs, const trial::Engine& engine, const track::Track& track,
                    std::span<const trial::Outcome> outcomes, int overlaps,
                    const base::Quaternion& expected) {
    EngineScore score;
    score.engine = engine.name();
    score.finished = static_cast<int>(trial::finalOrientations(outcomes).size());
    score.oriented =
        trial::tally(outcomes, expected, inputs.part->symmetry, inputs.settings.validation.tolerance).success;
    objectives::Evaluation evaluation = makeEvaluation(inputs, track, overlaps, outcomes);
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
    const std::array batches = {
        makeLearningBatch(makeScene(inputs.settings, inputs.part, track), winner, countCheckTrials(winner))};
    const auto learned = runTrials(*inputs.engine, batches, control);
    if (!learned) return learned.error();
    const auto judged = runTrials(reference, batches, control);
    if (!judged) return judged.error();

    const std::vector<trial::Outcome>& own = learned->front();
    const base::Quaternion expected = trial::findModalOrientation(
        trial::finalOrientations(own), inputs.part->symmetry, inputs.settings.validation.tolerance);
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
