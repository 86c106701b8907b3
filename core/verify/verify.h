#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/run_control.h"
#include "core/trial/engine.h"

namespace trapwright::verify {

/// One row of the table in decisions.md#engines-in-agreement: what must come out, what came out.
struct Row {
    std::string name;  // short, for people
    std::string expected;
    std::string got;
    bool passed = false;
};

/// Makes an engine with these options; cases vary the step and the number of threads.
using EngineFactory = std::function<std::unique_ptr<trial::Engine>(const trial::EngineOptions&)>;

/// A case gives one row or a few that belong together.
struct Case {
    std::string name;
    std::function<std::vector<Row>(const EngineFactory&, const base::RunControl&)> run;
};

/// Every case that any engine must pass, in the order of decisions.md#engines-in-agreement.
std::vector<Case> allCases();

/// Runs the cases whose names contain `filter` (all if empty), handing out each case's rows as they come.
/// True if all passed. A cancelled run counts as not passed.
bool runCases(const EngineFactory& factory, const std::string& filter, const base::RunControl& control,
              const std::function<void(const Row&)>& report);

}  // namespace trapwright::verify
