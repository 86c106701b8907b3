#include "core/study/evaluator.h"

#include <optional>
#include <string>

#include "core/base/parallel.h"
#include "core/geometry/self_overlap.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"

namespace trapwright::study {

namespace {

/// An individual on its way to a record.
struct Candidate {
    std::shared_ptr<const track::Track> track;
    int overlaps = 0;
    std::optional<trial::TrialBatch> batch;  // if it is to be simulated
    std::string failure;
};

Candidate prepare(const StudyInputs& inputs, int generation, int individual,
                  const evolution::Chromosome& chromosome) {
    const Settings& settings = inputs.settings;
    Candidate candidate;
    auto track = decodeTrack(settings.track, chromosome);
    if (!track) {
        candidate.failure = track.error().message;
        return candidate;
    }
    candidate.track = std::make_shared<const track::Track>(std::move(track).value());
    candidate.overlaps =
        geometry::countOverlappingTriangles(candidate.track->solid, candidate.track->surfaceTriangles);
    if (candidate.overlaps == 0 || settings.evolution.simulateOverlapping) {
        const TrialScene scene{&settings.simulation, inputs.part, candidate.track, settings.evolution.seed};
        candidate.batch =
            makeLearningBatch(scene, generation, individual, settings.evolution.trialsPerEvaluation);
    }
    return candidate;
}

void countEndings(std::span<const trial::Outcome> outcomes, IndividualRecord& record) {
    record.trials = static_cast<int>(outcomes.size());
    for (const trial::Outcome& outcome : outcomes) {
        if (outcome.ending == trial::Ending::finished) {
            ++record.finished;
        } else if (outcome.ending == trial::Ending::fellOff) {
            ++record.fellOff;
        } else {
            ++record.stuck;
        }
    }
}

bool isFinite(const base::Pose& pose) {
    return pose.position.allFinite() && pose.rotation.coeffs().allFinite();
}

base::Error brokenEngine(const trial::Engine& engine, const std::string& what) {
    return {"The engine " + engine.name() + " " + what +
            ". This is a fault of the engine; choose another one."};
}

}  // namespace

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
            const trial::Outcome& outcome = (*outcomes)[b][i];
            if (isFinite(outcome.initial) && isFinite(outcome.farthest)) continue;
            const base::StreamKey& stream = batches[b].trials[i].stream;
            return brokenEngine(engine, "lost the part in trial " + std::to_string(stream.trial) +
                                            " of individual " + std::to_string(stream.individual) +
                                            " of generation " + std::to_string(stream.generation) +
                                            ": its pose is not a number");
        }
    }
    return outcomes;
}

base::Result<std::vector<IndividualRecord>> evaluateGeneration(
    const StudyInputs& inputs, int generation, std::span<const evolution::Chromosome> population,
    const std::function<void(const GenerationPlan&)>& planned, base::RunControl control) {
    // Build all tracks.
    std::vector<Candidate> candidates(population.size());
    base::parallelFor(population.size(), inputs.threads, [&](std::size_t i, unsigned /*worker*/) {
        if (control.cancelled()) return;
        candidates[i] = prepare(inputs, generation, static_cast<int>(i), population[i]);
    });
    if (control.cancelled()) return base::Error{"The evaluation was cancelled."};

    // Simulate what can be simulated, all at once.
    std::vector<trial::TrialBatch> batches;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (!candidates[i].failure.empty()) {
            return base::Error{"The track of individual " + std::to_string(i) + " of generation " +
                               std::to_string(generation) + " cannot be built: " + candidates[i].failure};
        }
        if (candidates[i].batch) batches.push_back(std::move(*candidates[i].batch));
    }
    const EvolutionSettings& settings = inputs.settings.evolution;
    if (planned) {
        planned({generation, static_cast<int>(population.size()), static_cast<int>(batches.size()),
                 settings.trialsPerEvaluation, control.done()});
    }
    const auto outcomes = runTrials(*inputs.engine, batches, control);
    if (!outcomes) return outcomes.error();

    // Score; Eq. 5 goes over all pairs, so this is worth the threads, too.
    std::vector<std::size_t> batchOf(candidates.size());
    for (std::size_t i = 0, next = 0; i < candidates.size(); ++i) {
        if (candidates[i].batch) batchOf[i] = next++;
    }
    std::vector<IndividualRecord> records(candidates.size());
    base::parallelFor(candidates.size(), inputs.threads, [&](std::size_t i, unsigned /*worker*/) {
        const Candidate& candidate = candidates[i];
        IndividualRecord& record = records[i];
        record.chromosome = population[i];
        record.overlaps = candidate.overlaps;
        if (!candidate.batch) {
            record.fitness = trial::calcUnsimulatedFitness(*candidate.track, candidate.overlaps);
            return;
        }
        const std::vector<trial::Outcome>& own = (*outcomes)[batchOf[i]];
        countEndings(own, record);
        record.fitness = trial::calcFitness(*candidate.track, own, candidate.overlaps, inputs.part->symmetry,
                                            settings.orientationDistance);
    });
    return records;
}

}  // namespace trapwright::study
