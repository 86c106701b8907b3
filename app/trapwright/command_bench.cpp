#include <memory>

#include "app/trapwright/bench_run.h"
#include "app/trapwright/command.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

void addBenchCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<BenchOptions>();
    Command command = addCommand(
        program, invocation, "bench",
        "What a trial costs on this machine: named scenes, engines side by side, one thread, CPU time.",
        "trapwright bench --trials 500 --json", [options](const Console& console) {
            return runBench(*options, engines::registry().kinds(), console);
        });
    addBenchOptions(command, *options);
}

}  // namespace trapwright::app
