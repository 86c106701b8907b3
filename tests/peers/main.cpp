#include <CLI/CLI.hpp>
#include <exception>

#include "app/trapwright/bench_run.h"
#include "sim/engines/registry.h"
#include "tests/peers/mujoco_engine.h"
#include "tests/peers/ode_engine.h"

namespace {

using namespace trapwright;

template <class EngineType>
trial::EngineKind makePeer(const std::string& name) {
    return {name, [](const trial::EngineOptions& options) { return std::make_unique<EngineType>(options); }};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App program("trapwright bench, with other simulators beside Trapwright's engines: ode, mujoco.",
                     "trapwright-peers");
    app::BenchOptions options;
    bool json = false;
    app::addBenchOptions(app::Command(program), options);
    program.add_flag("--json", json, "Print one JSON document for machines and nothing else");
    CLI11_PARSE(program, argc, argv);

    std::vector<trial::EngineKind> known = engines::registry().kinds();
    known.push_back(makePeer<peers::OdeEngine>("ode"));
    known.push_back(makePeer<peers::MujocoEngine>("mujoco"));
    const app::Console console(json);
    auto result = app::runBench(options, known, console);
    return static_cast<int>(result ? *result : console.fail(result.error()));
}
