#include "sim/engines/registry.h"

#include <utility>

#include "sim/native/kernel.h"
#include "sim/native/native_engine.h"
#include "sim/simbody/certifying_engine.h"
#include "sim/simbody/simbody_engine.h"

namespace trapwright::engines {

namespace {

using trial::EngineRole;

template <class EngineType>
trial::EngineKind describe(std::string title, EngineRole role, double freeMotionTolerance,
                           bool takesStreams = true, std::string about = {}) {
    const auto make = [](const trial::EngineOptions& options) {
        return std::make_unique<EngineType>(options);
    };
    return {EngineType::kName,   make,         std::move(title), role,
            freeMotionTolerance, takesStreams, std::move(about)};
}

trial::EngineRegistry& ownRegistry() {
    static trial::EngineRegistry engines({
        describe<simbody::SimbodyEngine>("Simbody", EngineRole::reference, 1e-6),
        describe<native::NativeEngine>("Native", EngineRole::quick, 1e-3),
        describe<simbody::CertifyingEngine>(
            "Simbody, certifying", EngineRole::certifying, 1e-3, false,
            "the continuous contact law under an error-controlled integrator, some hundred times slower"),
    });
    return engines;
}

}  // namespace

const trial::EngineRegistry& registry() {
    return ownRegistry();
}

void replaceRegistry(trial::EngineRegistry engines) {
    ownRegistry() = std::move(engines);
}

std::vector<std::string> listInstructionSets() {
    return native::instructionSets();
}

base::Status useInstructionSet(const std::string& name) {
    std::string known;
    for (const std::string& one : native::instructionSets()) {
        known += (known.empty() ? "" : ", ") + one;
        if (one == name && native::useInstructionSet(name)) return base::success();
    }
    return base::Error{"This machine has no instruction set named \"" + name + "\"; it has " + known + "."};
}

}  // namespace trapwright::engines
