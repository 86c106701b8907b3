#pragma once

#include <optional>
#include <string>

namespace trapwright::app {

/// What an engine is wanted for.
enum class EngineUse {
    learning,  // a generation's trials, as many as possible
    judging    // what is looked at closely: selection, validation, a single track
};

/// The name of the engine that a study's setting or --engine means. "hybrid" learns with the quick engine and
/// judges with the reference; every other name means that engine for both.
std::string engineFor(const std::string& setting, EngineUse use);

/// The engine in which each generation's winner is checked: the reference if the setting is "hybrid", else
/// none.
std::optional<std::string> referenceFor(const std::string& setting);

}  // namespace trapwright::app
