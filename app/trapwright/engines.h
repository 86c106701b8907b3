#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/trapwright/exit_codes.h"
#include "core/base/result.h"
#include "core/trial/engine.h"

namespace trapwright::app {

using EngineFactory = std::function<std::unique_ptr<trial::Engine>(const trial::EngineOptions&)>;

/// The names of all engines.
std::vector<std::string> engineNames();

/// The engine of that name; an unknown one is a failure that lists those that there are.
Attempt<EngineFactory> findEngine(const std::string& name);

/// The same, made with these options.
Attempt<std::shared_ptr<const trial::Engine>> makeEngine(const std::string& name,
                                                         const trial::EngineOptions& options);

/// The same as a workflow::EngineMaker.
base::Result<std::shared_ptr<const trial::Engine>> makeWorkEngine(const std::string& name,
                                                                  const trial::EngineOptions& options);

}  // namespace trapwright::app
