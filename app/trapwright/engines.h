#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/trapwright/exit_codes.h"
#include "core/trial/engine_registry.h"

namespace trapwright::app {

/// The engine of that name among the program's; an unknown one is a failure that lists those that there are.
Attempt<trial::EngineKind> findEngine(const std::string& name);

/// The same, made with these options.
Attempt<std::shared_ptr<const trial::Engine>> makeEngine(const std::string& name,
                                                         const trial::EngineOptions& options);

/// The same of the engine that judges where --engine is `setting`, which may be hybrid.
Attempt<std::shared_ptr<const trial::Engine>> makeJudge(const std::string& setting,
                                                        const trial::EngineOptions& options);

/// The environment's TRAPWRIGHT_INSTRUCTION_SET, where it is set: what the native engine shall take, so that
/// a machine gives the bits of a lesser one. A failure if this machine has no such instructions.
Attempt<ExitCode> obeyEnvironment();
/// What it says; none if it is not set.
std::optional<std::string> askedInstructionSet();

}  // namespace trapwright::app
