#include "app/trapwright/engines.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "sim/native/native_engine.h"
#include "sim/simbody/certifying_engine.h"
#include "sim/simbody/simbody_engine.h"

namespace trapwright::app {

namespace {

template <class EngineType>
std::unique_ptr<trial::Engine> make(const trial::EngineOptions& options) {
    return std::make_unique<EngineType>(options);
}

struct NamedEngine {
    std::string_view name;
    std::unique_ptr<trial::Engine> (*make)(const trial::EngineOptions&);
};

constexpr std::array<NamedEngine, 3> kEngines = {{{"simbody", make<simbody::SimbodyEngine>},
                                                  {"native", make<native::NativeEngine>},
                                                  {"simbody-certifying", make<simbody::CertifyingEngine>}}};

}  // namespace

std::vector<std::string> engineNames() {
    std::vector<std::string> names;
    names.reserve(kEngines.size());
    for (const NamedEngine& engine : kEngines)
        names.emplace_back(engine.name);
    return names;
}

Attempt<EngineFactory> findEngine(const std::string& name) {
    std::string known;
    for (const NamedEngine& engine : kEngines) {
        if (engine.name == name) return EngineFactory(engine.make);
        known += fmt::format("{}{}", known.empty() ? "" : ", ", engine.name);
    }
    return Failure{ExitCode::usage,
                   fmt::format("There is no engine named \"{}\". The engines are: {}.", name, known)};
}

Attempt<std::shared_ptr<const trial::Engine>> makeEngine(const std::string& name,
                                                         const trial::EngineOptions& options) {
    auto factory = findEngine(name);
    if (!factory) return factory.failure();
    return std::shared_ptr<const trial::Engine>((*factory)(options));
}

base::Result<std::shared_ptr<const trial::Engine>> makeWorkEngine(const std::string& name,
                                                                  const trial::EngineOptions& options) {
    auto engine = makeEngine(name, options);
    if (!engine) return base::Error{engine.failure().message};
    return std::move(*engine);
}

}  // namespace trapwright::app
