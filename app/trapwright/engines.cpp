#include "app/trapwright/engines.h"

#include "sim/engines/registry.h"

namespace trapwright::app {

Attempt<trial::EngineKind> findEngine(const std::string& name) {
    const trial::EngineKind* kind = engines::registry().find(name);
    if (kind == nullptr) return Failure{ExitCode::usage, engines::registry().describeUnknown(name).message};
    return *kind;
}

Attempt<std::shared_ptr<const trial::Engine>> makeEngine(const std::string& name,
                                                         const trial::EngineOptions& options) {
    auto kind = findEngine(name);
    if (!kind) return kind.error();
    return std::shared_ptr<const trial::Engine>(kind->make(options));
}

Attempt<std::shared_ptr<const trial::Engine>> makeJudge(const std::string& setting,
                                                        const trial::EngineOptions& options) {
    return makeEngine(engines::registry().nameFor(setting, trial::EngineUse::judging), options);
}

}  // namespace trapwright::app
