#pragma once

#include "tests/peers/peer_engine.h"

namespace trapwright::peers {

/// Bullet, set up as somebody would who knows it (README.md tells how and why).
class BulletEngine : public PeerEngine {
 public:
    static constexpr double kDefaultStep = 5e-4;  // [s]

    explicit BulletEngine(const trial::EngineOptions& options = {}) : PeerEngine(options, kDefaultStep) {}

    [[nodiscard]] std::string name() const override { return "bullet"; }

 private:
    [[nodiscard]] base::Result<std::unique_ptr<PeerScene>> prepare(const trial::TrialBatch& batch,
                                                                   const part::Part& part) const override;
};

}  // namespace trapwright::peers
