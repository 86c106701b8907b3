#pragma once

#include "tests/peers/peer_engine.h"

namespace trapwright::peers {

/// No simulator that anybody else wrote, but one that shares no more with Trapwright's engines than the
/// formula of damping: neither the detector, nor friction, nor the integration. The part is a cloud of points
/// on its surface, each of which is held against the track's height below it. A point inside the track is
/// pushed out by a damped spring (Hunt and Crossley 1975) and held by another, which slides where friction is
/// overcome (Cundall and Strack 1979). Slow: it is there to tell who is right. For tracks that do not
/// overhang.
class PointsEngine : public PeerEngine {
 public:
    explicit PointsEngine(const trial::EngineOptions& options) : PeerEngine(options, 2e-6) {}
    [[nodiscard]] std::string name() const override { return "points"; }

 private:
    [[nodiscard]] base::Result<std::unique_ptr<PeerScene>> prepare(const trial::TrialBatch& batch,
                                                                   const part::Part& part) const override;
};

}  // namespace trapwright::peers
