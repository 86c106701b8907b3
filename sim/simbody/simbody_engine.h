#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/trial/engine.h"

namespace trapwright::simbody {

/// The reference engine: parts live in SimTK::MultibodySystems, contact is the discrete form of sim/contact
/// on Simbody's state at a fixed step. Every thread steps up to kBodiesPerSystem parts in one system of its
/// own and takes the next trial as soon as one has ended.
class SimbodyEngine : public trial::Engine {
 public:
    static constexpr const char* kName = "simbody";
    static constexpr double kDefaultStep = 2e-4;  // [s]
    static constexpr int kBodiesPerSystem = 16;

    explicit SimbodyEngine(const trial::EngineOptions& options = {});

    [[nodiscard]] std::string name() const override { return kName; }
    [[nodiscard]] double step() const override { return step_ > 0.0 ? step_ : kDefaultStep; }
    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch> batches, base::RunControl control) const override;
    [[nodiscard]] base::Result<trial::Trajectory> replay(const trial::TrialBatch& batch, std::size_t index,
                                                         double interval,
                                                         base::RunControl control) const override;

 private:
    [[nodiscard]] base::Result<trial::Trajectory> replayStream(const trial::TrialBatch& batch,
                                                               std::size_t index, double interval,
                                                               base::RunControl control) const;

    unsigned threads_;
    double step_;
    std::shared_ptr<trial::CostMeter> costs_;
};

}  // namespace trapwright::simbody
