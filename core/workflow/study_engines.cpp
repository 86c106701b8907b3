#include "core/workflow/study_engines.h"

#include <string_view>

namespace trapwright::workflow {

namespace {

constexpr std::string_view kHybrid = "hybrid";
constexpr std::string_view kQuickEngine = "native";
constexpr std::string_view kReferenceEngine = "simbody";

}  // namespace

std::string engineFor(const std::string& setting, EngineUse use) {
    if (setting != kHybrid) return setting;
    return std::string(use == EngineUse::learning ? kQuickEngine : kReferenceEngine);
}

std::optional<std::string> referenceFor(const std::string& setting) {
    if (setting != kHybrid) return std::nullopt;
    return std::string(kReferenceEngine);
}

}  // namespace trapwright::workflow
