#include "app/trapwright/engines.h"

#include <cstdlib>

#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

constexpr const char* kVariable = "TRAPWRIGHT_INSTRUCTION_SET";

}  // namespace

Attempt<trial::EngineKind> findEngine(const std::string& name) {
    const trial::EngineKind* kind = engines::registry().find(name);
    if (kind == nullptr) return Failure{ExitCode::usage, engines::registry().describeUnknown(name).message};
    return *kind;
}

Attempt<std::shared_ptr<const trial::Engine>> makeEngine(const std::string& name,
                                                         const trial::EngineOptions& options) {
    auto engine = engines::registry().make(name, options);
    if (!engine) return Failure{ExitCode::usage, engine.error().message};
    return *engine;
}

Attempt<std::shared_ptr<const trial::Engine>> makeJudge(const std::string& setting,
                                                        const trial::EngineOptions& options) {
    return makeEngine(engines::registry().nameFor(setting, trial::EngineUse::judging), options);
}

Attempt<ExitCode> obeyEnvironment() {
    const std::optional<std::string> set = askedInstructionSet();
    if (!set) return ExitCode::ok;
    const base::Status used = engines::useInstructionSet(*set);
    if (!used) return Failure{ExitCode::usage, std::string(kVariable) + ": " + used.error().message};
    return ExitCode::ok;
}

std::optional<std::string> askedInstructionSet() {
    const char* set = std::getenv(kVariable);
    if (set == nullptr || *set == '\0') return std::nullopt;
    return set;
}

}  // namespace trapwright::app
