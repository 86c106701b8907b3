#include "core/trial/engine_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/trial/backed_engine.h"

namespace trapwright::trial {

EngineRegistry::EngineRegistry(std::vector<EngineKind> kinds) : kinds_(std::move(kinds)) {
    assert(std::ranges::count(kinds_, EngineRole::quick, &EngineKind::role) == 1);
    assert(std::ranges::count(kinds_, EngineRole::reference, &EngineKind::role) == 1);
    assert(std::ranges::all_of(kinds_, [this](const EngineKind& kind) {
        return kind.make && kind.name != kHybrid && find(kind.name) == &kind;
    }));
}

const EngineKind& EngineRegistry::quick() const {
    return firstOf(EngineRole::quick);
}

const EngineKind& EngineRegistry::reference() const {
    return firstOf(EngineRole::reference);
}

const EngineKind& EngineRegistry::firstOf(EngineRole role) const {
    const auto found = std::ranges::find(kinds_, role, &EngineKind::role);
    assert(found != kinds_.end());
    return *found;
}

const EngineKind* EngineRegistry::find(std::string_view name) const {
    const auto found = std::ranges::find(kinds_, name, &EngineKind::name);
    return found == kinds_.end() ? nullptr : &*found;
}

base::Result<std::shared_ptr<const Engine>> EngineRegistry::make(std::string_view name,
                                                                 const EngineOptions& options) const {
    const EngineKind* kind = find(name);
    if (kind == nullptr) return describeUnknown(name);
    return std::shared_ptr<const Engine>(
        std::make_shared<const BackedEngine>(kind->make(options), reference(), options));
}

base::Error EngineRegistry::describeUnknown(std::string_view name) const {
    std::string known;
    for (const EngineKind& kind : kinds_)
        known += (known.empty() ? "" : ", ") + kind.name;
    return base::Error{fmt::format("There is no engine named \"{}\". The engines are: {}.", name, known)};
}

std::vector<std::string> EngineRegistry::settings() const {
    if (kinds_.empty()) return {};
    std::vector<std::string> settings = {kHybrid};
    for (const EngineRole role : {EngineRole::quick, EngineRole::reference, EngineRole::other})
        for (const EngineKind& kind : kinds_)
            if (kind.role == role) settings.push_back(kind.name);
    return settings;
}

std::string EngineRegistry::nameFor(const std::string& setting, EngineUse use) const {
    if (setting != kHybrid || kinds_.empty()) return setting;
    return use == EngineUse::learning ? quick().name : reference().name;
}

const EngineKind* EngineRegistry::referenceFor(std::string_view setting) const {
    return setting == kHybrid && !kinds_.empty() ? &reference() : nullptr;
}

}  // namespace trapwright::trial
