#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/trapwright/console.h"
#include "app/trapwright/exit_codes.h"
#include "app/trapwright/options.h"
#include "core/trial/engine_registry.h"

namespace trapwright::app {

/// What a benchmark is asked for on the command line.
struct BenchOptions {
    int trials = 200;
    int repeats = 3;
    double step = 0.0;            // [ms]; 0: each engine's own
    std::string engines = "all";  // or names with commas between
    std::string filter;           // part of the scenes' names
};

/// Adds --trials, --repeats, --scene, --step and --engine to a command.
void addBenchOptions(Command command, BenchOptions& options);

/// The engines in the order in which they were named, commas between; the first is what the others are
/// compared with. "all" leaves out what is too slow to learn with.
Attempt<std::vector<trial::EngineKind>> chooseContenders(const std::string& wanted,
                                                         std::span<const trial::EngineKind> known);

/// Times the engines that the options name among `known` on the scenes that they name, with progress and
/// Ctrl-C, and prints the table.
Attempt<ExitCode> runBench(const BenchOptions& options, std::span<const trial::EngineKind> known,
                           const Console& console);

}  // namespace trapwright::app
