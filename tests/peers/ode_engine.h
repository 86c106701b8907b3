#pragma once

#include "tests/peers/peer_engine.h"

namespace trapwright::peers {

/// The Open Dynamics Engine, set up as somebody would who knows it (README.md tells how and why).
class OdeEngine : public PeerEngine {
 public:
    static constexpr double kDefaultStep = 1e-3;  // [s]

    explicit OdeEngine(const trial::EngineOptions& options = {}) : PeerEngine(options, kDefaultStep) {}

    [[nodiscard]] std::string name() const override { return "ode"; }

 private:
    [[nodiscard]] base::Result<std::unique_ptr<PeerScene>> prepare(const trial::TrialBatch& batch,
                                                                   const part::Part& part) const override;
};

}  // namespace trapwright::peers
