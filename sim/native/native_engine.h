#pragma once

#include <memory>

#include "core/trial/engine.h"

namespace trapwright::native {

/// The engine for the millions of trials of a learning run: the discrete contact law of sim/contact in
/// floats, many trials side by side in wide vectors. Its own gravity, gyroscopic torque and drive; agrees
/// with SimbodyEngine as far as `trapwright verify` shows. On one machine the same bits for any number of
/// threads.
class NativeEngine : public trial::Engine {
 public:
    static constexpr const char* kName = "native";
    static constexpr double kDefaultStep = 2e-4;  // [s]

    explicit NativeEngine(const trial::EngineOptions& options);

    [[nodiscard]] std::string name() const override { return kName; }
    /// That of the kernel, which is never less than what the system's mathematics takes.
    [[nodiscard]] std::string instructionSet() const override;
    [[nodiscard]] double step() const override { return step_ > 0.0 ? step_ : kDefaultStep; }
    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch> batches, base::RunControl control) const override;
    [[nodiscard]] base::Result<trial::Trajectory> replay(const trial::TrialBatch& batch, std::size_t index,
                                                         double interval,
                                                         base::RunControl control) const override;

 private:
    unsigned threads_;
    double step_;
    std::shared_ptr<trial::CostMeter> costs_;
};

}  // namespace trapwright::native
