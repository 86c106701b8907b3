#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/trial/engine.h"

namespace trapwright::workflow {

/// Makes the engine of that name; an error that lists the names otherwise. The engines are not known here:
/// the program hands this in.
using EngineMaker = std::function<base::Result<std::shared_ptr<const trial::Engine>>(
    const std::string& name, const trial::EngineOptions& options)>;

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

}  // namespace trapwright::workflow
