#include <CLI/CLI.hpp>
#include <charconv>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "app/trapwright/bench_run.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/track_subject.h"
#include "app/trapwright/work_display.h"
#include "sim/engines/registry.h"
#include "tests/peers/bullet_engine.h"
#include "tests/peers/mujoco_engine.h"
#include "tests/peers/ode_engine.h"
#include "tests/peers/points_engine.h"
#include "tests/peers/transfer.h"
#include "tests/peers/work_precision.h"

namespace {

using namespace trapwright;

/// Steps at which engines are held against what is known. [s]
constexpr double kSteps[] = {2e-5, 5e-5, 1e-4, 2e-4, 3e-4, 5e-4, 1e-3};
/// What an engine can be told. [ms]
constexpr double kLeastStep = 1e-4;
constexpr double kLargestStep = 2.0;
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

/// Engines as for --engine, any of them at a step of its own in ms: "simbody,ode,ode@0.25".
app::Attempt<std::vector<peers::Contender>> chooseSteps(const app::BenchOptions& options,
                                                        const std::vector<trial::EngineKind>& known) {
    std::vector<peers::Contender> contenders;
    std::istringstream list(options.engines);
    for (std::string name; std::getline(list, name, ',');) {
        double step = options.step;  // [ms]
        if (const auto at = name.find('@'); at != std::string::npos) {
            const char* end = name.data() + name.size();
            const bool read = std::from_chars(name.data() + at + 1, end, step).ptr == end;
            if (!read || !(step >= kLeastStep && step <= kLargestStep))
                return app::Failure{app::ExitCode::usage,
                                    "--engine " + name + ": behind the @ comes a step from 0.0001 to 2 ms."};
            name.erase(at);
        }
        const auto kinds = app::chooseContenders(name, known);
        if (!kinds) return kinds.error();
        for (const trial::EngineKind& kind : *kinds)
            contenders.push_back({kind, step * 1e-3});
    }
    return contenders;
}

/// What --transfer is asked for.
struct TransferOptions {
    app::SubjectRequest subject;
    std::string csv;
    std::vector<double> stretch;  // none, or its two ends [mm]
};

/// Simulates the transfer's trials in this engine and prints its rows.
app::Attempt<app::ExitCode> runContender(peers::Transfer& transfer, const peers::Contender& contender,
                                         const app::Console& console) {
    const std::size_t before = transfer.rows.size();
    const base::RunControl control;
    const auto added = [&] {
        const auto trials = transfer.scenes.size() * transfer.scenes.front().batch.trials.size();
        const app::WorkDisplay display(
            console, app::watchTrials(contender.kind.name, static_cast<std::int64_t>(trials), control));
        return peers::addEngine(transfer, contender, control);
    }();
    if (!added) return app::describeRunFailure(control, added.error());
    if (before == 0) console.print(peers::transferHeader(transfer));
    for (std::size_t i = before; i < transfer.rows.size(); ++i)
        console.print(peers::describeTransfer(transfer, transfer.rows[i]));
    return app::ExitCode::ok;
}

app::Attempt<app::ExitCode> runTransfer(const TransferOptions& asked, const app::BenchOptions& options,
                                        const std::vector<trial::EngineKind>& known,
                                        const app::Console& console) {
    auto contenders = chooseSteps(options, known);
    if (!contenders) return contenders.error();
    const auto loaded = app::loadSubject(asked.subject, console);
    if (!loaded) return loaded.error();
    // The reference comes first: the others are held against it.
    const trial::EngineKind& reference = engines::registry().reference();
    std::erase_if(contenders.value(), [&](const peers::Contender& contender) {
        return contender.kind.name == reference.name && contender.step == 0.0;
    });
    contenders->insert(contenders->begin(), {reference, 0.0});

    peers::Transfer transfer =
        peers::makeTransfer(loaded->inputs.settings, loaded->inputs.part, loaded->track, options.trials);
    if (!asked.stretch.empty()) {
        const peers::Stretch stretch{asked.stretch.front() * base::kMillimetre,
                                     asked.stretch.back() * base::kMillimetre};
        const base::RunControl control;
        if (!(stretch.from < stretch.to))
            return app::Failure{app::ExitCode::usage, "--stretch: give where it begins, then where it ends."};
        if (const auto begun = peers::beginAtStretch(transfer, stretch, contenders->front(), control); !begun)
            return app::describeRunFailure(control, begun.error());
    }
    for (const peers::Contender& contender : *contenders) {
        const auto ran = runContender(transfer, contender, console);
        if (!ran) return ran.error();
    }
    if (transfer.stretch)
        console.print(
            "Passes too, stays too: of those that pass in the first engine, and of those that do not.\n\n" +
            peers::describeWays(transfer));
    else
        console.print(
            "Correct: of those that arrive. Points: of success, more than in the first engine. Other: trials "
            "that come to something else than in the first engine.\n");
    if (asked.csv.empty()) return app::ExitCode::ok;
    const auto written = peers::writeTransferTrials(transfer, asked.csv);
    if (!written) return app::Failure{app::ExitCode::cannotWrite, written.error().message};
    return app::ExitCode::ok;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App program(
        "trapwright bench, with other simulators beside Trapwright's engines: ode, mujoco, bullet, points.",
        "trapwright-peers");
    app::BenchOptions options;
    bool json = false;
    std::string folder;
    TransferOptions transfer;
    app::addBenchOptions(app::Command(program), options);
    program.add_flag("--json", json, "Print one JSON document for machines and nothing else");
    program
        .add_option(
            "--work-precision", folder,
            "Instead: how right the engines are on motions whose truth is known, and what that costs, "
            "at several steps or that of --step; a table and a chart into this folder")
        ->check(CLI::ExistingDirectory);
    app::TrackRequest& onTrack = transfer.subject.track;
    auto* track = program.add_option("--transfer", onTrack.file,
                                     "Instead: the trials of this track (JSON), or of a study's final one, "
                                     "in each engine, as set and all over the operating box; engines may "
                                     "be named as ode@0.25 for a step of their own in ms");
    program.add_option("--part", onTrack.part.part, "On that track, unless it is a study's (cuboid)")
        ->needs(track);
    program.add_option("--material", onTrack.part.material, "Of the part, likewise")->needs(track);
    program.add_option("--friction", onTrack.friction, "Static and kinetic, likewise (0.5)")->needs(track);
    program.add_option("--restitution", onTrack.restitution, "Likewise (0.2)")->needs(track);
    program
        .add_option("--stretch", transfer.stretch,
                    "Where it begins and ends, in mm along the track: each trial begins as the reference "
                    "engine's part is "
                    "when it comes there, and what is counted is who comes to the end")
        ->needs(track)
        ->expected(2);
    program.add_option("--csv", transfer.csv, "Also each of these trials into this file")->needs(track);
    CLI11_PARSE(program, argc, argv);

    std::vector<trial::EngineKind> known = engines::registry().kinds();
    known.push_back(makePeer<peers::OdeEngine>("ode"));
    known.push_back(makePeer<peers::MujocoEngine>("mujoco"));
    known.push_back(makePeer<peers::BulletEngine>("bullet"));
    known.push_back(makePeer<peers::PointsEngine>("points"));
    const app::Console console(json);
    auto result = !folder.empty()                        ? runWorkPrecision(folder, options, known, console)
                  : !transfer.subject.track.file.empty() ? runTransfer(transfer, options, known, console)
                                                         : app::runBench(options, known, console);
    return static_cast<int>(result ? *result : console.fail(result.error()));
}
