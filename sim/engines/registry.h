#pragma once

#include "core/trial/engine_registry.h"

namespace trapwright::engines {

/// Every engine of Trapwright. The one place that knows them all.
const trial::EngineRegistry& registry();

}  // namespace trapwright::engines
