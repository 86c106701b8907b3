#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/trial/engine.h"
#include "core/trial/engine_registry.h"
#include "core/trial/remade_trials.h"

namespace trapwright::trial {

/// An engine with a floor below it: a trial that it cannot finish, because it fails or loses the part, is
/// made again by the reference in the reference's own step; what that cannot finish either counts as stuck,
/// so that no single trial ends a run (decisions.md#trials-that-no-engine-finishes). A trial's outcome still
/// depends on its batch's parameters and its spec alone.
class BackedEngine : public Engine {
 public:
    /// `options`: those that `engine` was made with; their `remade` is told of each such trial.
    BackedEngine(std::shared_ptr<const Engine> engine, EngineKind reference, EngineOptions options);

    [[nodiscard]] std::string name() const override { return engine_->name(); }
    [[nodiscard]] std::string instructionSet() const override { return engine_->instructionSet(); }
    [[nodiscard]] double step() const override { return engine_->step(); }

    /// An error only if cancelled, if no engine can simulate the batches, or if neither engine finished any
    /// of several trials.
    [[nodiscard]] base::Result<std::vector<std::vector<Outcome>>> run(
        std::span<const TrialBatch> batches, base::RunControl control) const override;

    /// Of a trial that the reference had to make, the reference's.
    [[nodiscard]] base::Result<Trajectory> replay(const TrialBatch& batch, std::size_t index, double interval,
                                                  base::RunControl control) const override;

 private:
    std::shared_ptr<const Engine> engine_;
    EngineKind reference_;
    EngineOptions options_;
};

}  // namespace trapwright::trial
