#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/trial/engine.h"

namespace trapwright::simbody {

/// The certifying mode (decisions.md#contact-features): the continuous contact law under an error-controlled
/// integrator, some hundred times slower than SimbodyEngine, which it is there to be held against.
class CertifyingEngine : public trial::Engine {
 public:
    static constexpr const char* kName = "simbody-certifying";
    static constexpr double kDefaultStep = 2e-3;  // [s]

    /// options.step is the interval at which the ending is looked for; the integrator chooses its own steps.
    explicit CertifyingEngine(const trial::EngineOptions& options = {});

    [[nodiscard]] std::string name() const override { return kName; }
    [[nodiscard]] double step() const override { return step_; }
    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch> batches, base::RunControl control) const override;
    [[nodiscard]] base::Result<trial::Trajectory> replay(const trial::TrialBatch& batch, std::size_t index,
                                                         double interval,
                                                         base::RunControl control) const override;

 private:
    unsigned threads_;
    double step_;
};

}  // namespace trapwright::simbody
