#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/trial/costs.h"
#include "core/trial/engine.h"
#include "sim/contact/impulse_solver.h"

namespace trapwright::peers {

/// One running trial in a foreign simulator.
class PeerTrial {
 public:
    PeerTrial() = default;
    PeerTrial(const PeerTrial&) = delete;
    PeerTrial& operator=(const PeerTrial&) = delete;
    virtual ~PeerTrial() = default;

    /// Advances part and track by one step.
    virtual void step(trial::CostLaps& laps) = 0;
    /// Part frame to the track's mesh frame.
    [[nodiscard]] virtual base::Pose poseInTrack() const = 0;
    [[nodiscard]] virtual base::Pose pose() const = 0;  // part frame to room
    [[nodiscard]] virtual contact::BodyMotion motion() const = 0;
    [[nodiscard]] virtual int contacts() const = 0;  // of the last step
};

/// What all trials of a batch with the same part share: its track and that part as the simulator wants them.
class PeerScene {
 public:
    PeerScene() = default;
    PeerScene(const PeerScene&) = delete;
    PeerScene& operator=(const PeerScene&) = delete;
    virtual ~PeerScene() = default;

    /// From any thread.
    [[nodiscard]] virtual std::unique_ptr<PeerTrial> start(std::size_t trial) const = 0;
};

/// A foreign simulator as an engine: it is given the same trials and ends them by the same rules as
/// Trapwright's own.
class PeerEngine : public trial::Engine {
 public:
    [[nodiscard]] double step() const override { return step_; }
    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch> batches, base::RunControl control) const override;
    [[nodiscard]] base::Result<trial::Trajectory> replay(const trial::TrialBatch& batch, std::size_t index,
                                                         double interval,
                                                         base::RunControl control) const override;

 protected:
    PeerEngine(const trial::EngineOptions& options, double defaultStep);

 private:
    /// Of one of the batch's parts. An error that says why the simulator cannot do this batch, which must
    /// outlive the scene.
    [[nodiscard]] virtual base::Result<std::unique_ptr<PeerScene>> prepare(const trial::TrialBatch& batch,
                                                                           const part::Part& part) const = 0;
    /// Of each of the batch's parts.
    [[nodiscard]] base::Result<std::vector<std::unique_ptr<PeerScene>>> prepareAll(
        const trial::TrialBatch& batch) const;

    unsigned threads_;
    double step_;
    std::shared_ptr<trial::CostMeter> costs_;
};

}  // namespace trapwright::peers
