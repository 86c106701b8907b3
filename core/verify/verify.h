#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/run_control.h"
#include "core/trial/engine_registry.h"

namespace trapwright::verify {

/// One row of the table in decisions.md#engines-in-agreement: what must come out, what came out.
struct Row {
    std::string name;  // short, for people
    std::string expected;
    std::string got;
    bool passed = false;
};

/// A case gives one row or a few that belong together. It varies the engine's step and number of threads.
struct Case {
    std::string name;
    std::function<std::vector<Row>(const trial::EngineKind&, const base::RunControl&)> run;
    bool hasSeveralParts = false;  // for engines that can (EngineKind::takesStreams)
};

/// Every case that an engine must pass, in the order of decisions.md#engines-in-agreement.
std::vector<Case> allCases();

/// Runs the cases whose names contain `filter` (all if empty), handing out each case's rows as they come.
/// True if all passed. A cancelled run counts as not passed.
bool runCases(const trial::EngineKind& kind, const std::string& filter, const base::RunControl& control,
              const std::function<void(const Row&)>& report);

}  // namespace trapwright::verify
