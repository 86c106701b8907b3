#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/stats/samples.h"
#include "core/trial/engine.h"

/// Two engines on the same trials: decisions.md#engines-in-agreement, last row.
namespace trapwright::verify {

/// One part on one track.
struct AgreementScene {
    std::string part;
    std::string track;  // "flat", "hills", "learned"
    trial::TrialBatch batch;
    trial::TrialBatch fresh;  // as many other starts
};

/// The cuboid, the cone and the L bracket, each on a level track, on hills where about half of its trials
/// fail, and on the learned track, with this many trials. Errors: a part that cannot be built.
base::Result<std::vector<AgreementScene>> makeAgreementScenes(
    const std::shared_ptr<const track::Track>& learned, int trials);

/// What came out of one engine's trials.
struct EngineTally {
    int finished = 0;
    int oriented = 0;         // finished within 25 deg of both engines' most frequent final orientation
    double medianTime = 0.0;  // of those that finished [s]; 0 if none did
};

/// How far two engines agree on one scene.
struct Agreement {
    std::string part;
    std::string track;
    int trials = 0;
    EngineTally engine;
    EngineTally reference;
    int finishedInOne = 0;   // trials, of the same start, that finished in one engine but not in the other
    double finishedP = 1.0;  // that this parts as unevenly by chance (McNemar)
    double orientedP = 1.0;
    stats::KolmogorovSmirnov times;  // of the transit times of those that finished
    double familyP = 1.0;            // the least of the three, adjusted for all tests of the table (Holm)
    bool alikeAlone = false;         // each rate in the other's 95 % interval, times with p > 0.01
    /// The least of the three on fresh starts, adjusted for the three, where familyP fails the row.
    std::optional<double> freshP;

    /// Engines that are alike fail somewhere in a table with a probability of 0.25 % at most: of 5 % on the
    /// same starts, whose luck every version of an engine meets again, and of 5 % of these on fresh ones.
    /// `alikeAlone` they miss in many a table: see README.md.
    [[nodiscard]] bool passed() const { return familyP > kLevel || freshP.value_or(0.0) > kLevel; }

    static constexpr double kLevel = 0.05;
};

/// Simulates every scene with both engines, and those that fail again on fresh starts. Advances `control` by
/// two per trial. Errors: engines, cancelled.
base::Result<std::vector<Agreement>> compareEngines(const trial::Engine& engine,
                                                    const trial::Engine& reference,
                                                    const std::vector<AgreementScene>& scenes,
                                                    const base::RunControl& control);

}  // namespace trapwright::verify
