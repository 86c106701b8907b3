#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/trial/engine_registry.h"

namespace trapwright::engines {

/// Every engine of Trapwright. The one place that knows them all.
const trial::EngineRegistry& registry();

/// Has these be the registry from now on: the same engines in another place, as on a cluster. To be called
/// before anybody asks for an engine.
void replaceRegistry(trial::EngineRegistry engines);

/// Has engines that choose their instructions by the processor (the native one) take these from now on, of
/// those that this machine has, and so give the bits of a machine that has no better ones. An error names
/// those that there are.
base::Status useInstructionSet(const std::string& name);
/// Those that this machine has, the best first.
std::vector<std::string> listInstructionSets();

}  // namespace trapwright::engines
