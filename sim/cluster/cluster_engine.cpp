#include <memory>
#include <utility>

#include "sim/cluster/coordinator.h"

namespace trapwright::cluster {

namespace {

/// An engine on all ranks of a job.
class ClusterEngine : public trial::Engine {
 public:
    ClusterEngine(std::unique_ptr<trial::Engine> here, trial::EngineOptions options, Coordinator& coordinator)
        : here_(std::move(here)), options_(std::move(options)), coordinator_(&coordinator) {}

    [[nodiscard]] std::string name() const override { return here_->name(); }
    [[nodiscard]] std::string instructionSet() const override { return here_->instructionSet(); }
    [[nodiscard]] double step() const override { return here_->step(); }

    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch> batches, base::RunControl control) const override {
        return coordinator_->run(name(), options_, batches, std::move(control));
    }

    [[nodiscard]] base::Result<trial::Trajectory> replay(const trial::TrialBatch& batch, std::size_t index,
                                                         double interval,
                                                         base::RunControl control) const override {
        return here_->replay(batch, index, interval, std::move(control));
    }

 private:
    std::unique_ptr<trial::Engine> here_;
    trial::EngineOptions options_;
    Coordinator* coordinator_;
};

}  // namespace

trial::EngineRegistry spread(const trial::EngineRegistry& engines, Coordinator& coordinator) {
    std::vector<trial::EngineKind> kinds = engines.kinds();
    for (trial::EngineKind& kind : kinds) {
        kind.make = [make = kind.make, &coordinator](const trial::EngineOptions& options) {
            return std::make_unique<ClusterEngine>(make(options), options, coordinator);
        };
    }
    return trial::EngineRegistry(std::move(kinds));
}

}  // namespace trapwright::cluster
