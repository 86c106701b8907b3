#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/study/operating_box.h"
#include "core/study/records.h"
#include "core/study/settings.h"
#include "core/trial/batch.h"
#include "core/trial/orientations.h"
#include "core/trial/outcome.h"
#include "core/trial/predicted_speed.h"

namespace trapwright::study {

/// What every trial on one track of a study has in common.
struct TrialScene {
    const SimulationSettings* simulation = nullptr;
    std::shared_ptr<const part::Part> part;
    std::shared_ptr<const track::Track> track;
    std::uint64_t seed = 0;            // of the study
    bool commonRandomNumbers = false;  // see makeLearningBatch
    std::optional<double> learningStuckTime =
        std::nullopt;           // of makeLearningBatch, if less than the simulation's [s]
    double learningStep = 0.0;  // of makeLearningBatch; 0: the engine's own [s]
    /// The operating box that trials vary over, and the parts that they then have. Null: none does.
    const trial::OperatingBox* box = nullptr;
    std::vector<std::shared_ptr<const part::Part>> specimens{};
    TrialConditions whileLearning = TrialConditions::nominal;
    double cornerShare = 0.0;                                 // of makeLearningBatch ...
    int cornersFrom = 0;                                      // ... from that generation on
    TrialConditions whileJudging = TrialConditions::nominal;  // selection and validation
};

/// The scene of a track of the study. Refers to `settings`.
TrialScene makeScene(const Settings& settings, const Specimens& specimens,
                     std::shared_ptr<const track::Track> track);
/// Makes the specimens, too: for a single track.
TrialScene makeScene(const Settings& settings, const std::shared_ptr<const part::Part>& part,
                     std::shared_ptr<const track::Track> track);

/// What the drive does to a part that lies flat on this feeder, as it slopes. Up to a tenth of a second the
/// first time; answers are remembered, as all tracks of a study ask the same. The settings must be without
/// problems.
trial::ConveyingPrediction predictOnFeeder(const SimulationSettings& simulation,
                                           const track::FeederShape& shape);

/// When trials on this track end: as set. A time limit of 0 is as long as a part needs to the finish at
/// 20 mm/s, 10 s at least, so that what is slow on a long track is not called stuck (decisions.md#endings);
/// on a feeder that climbs as many times longer as a flat part is slower than on a level one
/// (predictOnFeeder).
trial::Termination terminationOn(const SimulationSettings& simulation, const track::Track& track);

/// Each trial's start is drawn from its own stream (seed, generation, individual, trial, purpose), so that
/// any single trial can be made again from the study alone. Each of these makes the batch anew with the same
/// bits. Where trials vary over the operating box, trial i of all individuals of a generation is at the same
/// place in it.

/// The trials by which an individual is judged while learning: `trials` of them from `first` on. With common
/// random numbers all individuals of a generation have the streams of individual 0, so that each meets the
/// same starts and a difference of two scores has less noise. What does not move on is given up sooner than
/// elsewhere (EvolutionSettings::learningStuckTime), and steps are larger (chooseLearningStep).
trial::TrialBatch makeLearningBatch(const TrialScene& scene, const IndividualId& individual, int trials,
                                    int first = 0);

/// Fresh trials of a winner (paper, section 6.1.1).
trial::TrialBatch makeSelectionBatch(const TrialScene& scene, const IndividualId& individual, int trials);

/// More of them, all in corners of the operating box.
trial::TrialBatch makeCornerBatch(const TrialScene& scene, const IndividualId& individual, int trials);

/// Trials that start near one of the part's stable poses (paper, section 6.2;
/// decisions.md#selection-and-success). Trial i of pose p is trial p x trials + i of the stream.
trial::TrialBatch makeValidationBatch(const TrialScene& scene, const IndividualId& individual, int pose,
                                      int trials);

/// Where the trials of a batch are in the operating box; empty if they are all alike.
std::vector<trial::BoxPlace> listPlaces(const trial::TrialBatch& batch);

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
