#include <CLI/CLI.hpp>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "app/trapwright/bench_run.h"
#include "sim/engines/registry.h"
#include "tests/peers/bullet_engine.h"
#include "tests/peers/mujoco_engine.h"
#include "tests/peers/ode_engine.h"
#include "tests/peers/work_precision.h"

namespace {

using namespace trapwright;

/// Steps at which engines are held against what is known. [s]
constexpr double kSteps[] = {2e-5, 5e-5, 1e-4, 2e-4, 3e-4, 5e-4, 1e-3};
/// What "as right as" means in the comparison of costs.
constexpr double kPrecisions[] = {0.02, 0.05};

template <class EngineType>
trial::EngineKind makePeer(const std::string& name) {
    return {name, [](const trial::EngineOptions& options) { return std::make_unique<EngineType>(options); }};
}

app::Attempt<app::ExitCode> runWorkPrecision(const std::string& folder, const app::BenchOptions& options,
                                             const std::vector<trial::EngineKind>& known,
                                             const app::Console& console) {
    const auto contenders = app::chooseContenders(options.engines, known);
    if (!contenders) return contenders.error();
    console.print("Engine       Subject      Step ms     Largest       RMS   CPU s per s simulated\n");
    std::vector<double> steps(std::begin(kSteps), std::end(kSteps));
    if (options.step > 0.0) steps = {options.step * 1e-3};
    std::vector<peers::PrecisionPoint> points;
    for (const trial::EngineKind& kind : *contenders) {
        for (const double step : steps) {
            const auto measured = peers::measurePrecision(kind, step);
            if (!measured) return app::Failure{app::ExitCode::fault, measured.error().message};
            console.print(peers::describePrecision(*measured));
            points.insert(points.end(), measured->begin(), measured->end());
        }
    }
    for (const double precision : kPrecisions)
        console.print(peers::compareAtPrecision(points, precision));
    const auto written = peers::writePrecisionChart(points, folder);
    if (!written) return app::Failure{app::ExitCode::cannotWrite, written.error().message};
    return app::ExitCode::ok;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App program(
        "trapwright bench, with other simulators beside Trapwright's engines: ode, mujoco, bullet.",
        "trapwright-peers");
    app::BenchOptions options;
    bool json = false;
    std::string folder;
    app::addBenchOptions(app::Command(program), options);
    program.add_flag("--json", json, "Print one JSON document for machines and nothing else");
    program
        .add_option(
            "--work-precision", folder,
            "Instead: how right the engines are on motions whose truth is known, and what that costs, "
            "at several steps or that of --step; a table and a chart into this folder")
        ->check(CLI::ExistingDirectory);
    CLI11_PARSE(program, argc, argv);

    std::vector<trial::EngineKind> known = engines::registry().kinds();
    known.push_back(makePeer<peers::OdeEngine>("ode"));
    known.push_back(makePeer<peers::MujocoEngine>("mujoco"));
    known.push_back(makePeer<peers::BulletEngine>("bullet"));
    const app::Console console(json);
    auto result = folder.empty() ? app::runBench(options, known, console)
                                 : runWorkPrecision(folder, options, known, console);
    return static_cast<int>(result ? *result : console.fail(result.error()));
}
