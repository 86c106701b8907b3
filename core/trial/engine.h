#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/instruction_set.h"
#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/trial/batch.h"
#include "core/trial/costs.h"
#include "core/trial/outcome.h"
#include "core/trial/remade_trials.h"

namespace trapwright::trial {

/// What every engine can be told. 0 leaves the choice to the engine.
struct EngineOptions {
    unsigned threads = 0;  // 0: all processors
    double step = 0.0;     // of simulated time [s], where a batch asks for none; 0: the engine's own
    /// Told what run() spent on what, by engines that can tell. Null: nothing is measured.
    std::shared_ptr<CostMeter> costs = nullptr;
    /// Told of trials that the engine could not finish, by engines that an EngineRegistry made. Null: nobody
    /// is.
    std::shared_ptr<RemadeTrials> remade = nullptr;
};

/// A rigid-body simulator that judges tracks. Takes whole batches, so that it may use threads, wide
/// instructions or other machines as it likes. The outcome of a trial depends on its batch's parameters and
/// its own TrialSpec alone: not on the threads, nor on the other trials. Safe to call from several threads.
/// Stands still within 0.2 s while its control is paused.
class Engine {
 public:
    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    virtual ~Engine() = default;

    /// As in studies, on the command line and in an EngineRegistry.
    [[nodiscard]] virtual std::string name() const = 0;
    /// The processor's instructions that its results depend on: the same program gives the same bits on every
    /// machine where this is the same.
    [[nodiscard]] virtual std::string instructionSet() const { return base::mathInstructionSet(); }
    /// The step of simulated time where a batch asks for none. [s]
    [[nodiscard]] virtual double step() const = 0;

    /// Simulates every trial: result[b][i] is the outcome of batches[b].trials[i]. Advances `control` by one
    /// per finished trial. An error if cancelled (within 0.2 s) or if a batch cannot be simulated.
    [[nodiscard]] virtual base::Result<std::vector<std::vector<Outcome>>> run(
        std::span<const TrialBatch> batches, base::RunControl control) const = 0;

    /// Re-simulates trial `index` of the batch, bit for bit as run() does, and records it every `interval`
    /// seconds.
    [[nodiscard]] virtual base::Result<Trajectory> replay(const TrialBatch& batch, std::size_t index,
                                                          double interval,
                                                          base::RunControl control) const = 0;
};

}  // namespace trapwright::trial
