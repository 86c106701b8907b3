#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/bench/bench_scenes.h"
#include "core/study/trial_batches.h"
#include "core/trial/costs.h"
#include "core/trial/engine_registry.h"

namespace trapwright::bench {

struct Plan {
    int trials = 200;   // of each scene, engine and repeat
    int repeats = 3;    // the engines take turns, so that a busy moment meets them all
    double step = 0.0;  // of all engines [s]; 0: each one's own
};

/// What this process has computed so far. [s]
double readCpuClock();

/// How many trials one scene takes, those for the shares included.
int countAllTrials(const Plan& plan, std::size_t contenders);

/// What one engine made of one scene.
struct Measurement {
    std::string engine;
    double step = 0.0;               // [s]
    std::vector<double> cpuSeconds;  // of all trials on one thread, one per repeat [s]
    double ratio = 1.0;              // trials per second over the first engine's, median of the repeats
    study::TrialCounts counts;
    trial::Costs costs;   // of the run for the shares; all 0 if the engine does not tell
    std::string problem;  // why this engine cannot do the scene; the rest is then empty

    /// Median of the repeats. [s]
    [[nodiscard]] double secondsPerTrial() const;
    [[nodiscard]] double stepsPerTrial() const;
    [[nodiscard]] double secondsPerStep() const { return secondsPerTrial() / stepsPerTrial(); }
};

/// Times the contenders side by side on one scene, on one thread each, by the CPU time of this process: on a
/// busy machine the wall clock would measure the others too. The shares of the cost come from a shorter run
/// of their own, since telling them apart takes time. `control` advances by one per trial. An error only if
/// cancelled.
base::Result<std::vector<Measurement>> runScene(const Scene& scene,
                                                std::span<const trial::EngineKind> contenders,
                                                const Plan& plan, const base::RunControl& control);

}  // namespace trapwright::bench
