#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/part_source.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/study/settings.h"
#include "core/verify/conveying.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

struct Options {
    PartRequest part;
    double from = 0.4;        // [mm]
    double to = 1.2;          // [mm]
    double step = 0.02;       // [mm]
    double frequency = 50.0;  // [Hz]
    double angle = 12.0;      // [deg]
    double slope = 0.0;       // [deg]
    std::optional<double> friction;
    std::optional<double> restitution;
    std::string engine = engines::registry().reference().name;
};

trial::Vibration driveFor(const Options& options, int row) {
    trial::Vibration drive;
    drive.frequency = options.frequency;
    drive.angle = options.angle * base::kDegree;
    drive.halfStroke = (options.from + row * options.step) * base::kMillimetre;
    return drive;
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    if (!(options.from <= options.to)) {
        return Failure{ExitCode::usage,
                       fmt::format("--from {} is more than --to {}: give the smaller half-stroke first.",
                                   options.from, options.to)};
    }
    constexpr double kRounding = 1e-9;
    constexpr double kMostRows = 10000;
    const double rows = std::floor((options.to - options.from) / options.step + kRounding) + 1.0;
    if (rows > kMostRows)
        return Failure{ExitCode::usage, fmt::format("--step {} is too fine.", options.step)};
    auto loaded = loadPart(options.part, console);
    if (!loaded) return loaded.error();
    auto engine = makeJudge(options.engine, {});
    if (!engine) return engine.error();

    verify::ConveyingScene scene;
    scene.part = loaded->part;
    scene.slope = options.slope * base::kDegree;
    scene.contact.staticFriction = options.friction.value_or(scene.contact.staticFriction);
    scene.contact.kineticFriction = options.friction.value_or(scene.contact.kineticFriction);
    scene.contact.restitution = options.restitution.value_or(scene.contact.restitution);
    base::RunControl control;
    nlohmann::ordered_json table = nlohmann::ordered_json::array();
    WorkDisplay display(console,
                        watchTrials("Sweep", static_cast<std::int64_t>(rows) * scene.headings, control));
    display.print(fmt::format(
        "{} on a {} track at {:g} Hz, {:g} deg, friction {:g}, restitution {:g}; {} headings\n"
        "Half-stroke   Throw number   Speed    least ... most\n",
        scene.part->name, options.slope == 0.0 ? "level" : fmt::format("{:+g} deg", options.slope),
        options.frequency, options.angle, scene.contact.staticFriction, scene.contact.restitution,
        scene.headings));
    for (int row = 0; row < static_cast<int>(rows); ++row) {
        scene.drive = driveFor(options, row);
        const auto speed = verify::measureConveyingSpeed(**engine, scene, control);
        if (!speed) return describeRunFailure(control, speed.error());
        const double throwNumber =
            trial::calcThrowNumber(scene.drive, base::kStandardGravity * std::cos(scene.slope));
        display.print(fmt::format("{:8.3f} mm {:14.3f} {:7.2f} {:8.2f} ... {:.2f} mm/s\n",
                                  scene.drive.halfStroke * 1e3, throwNumber, speed->mean * 1e3,
                                  speed->least * 1e3, speed->most * 1e3));
        table.push_back({{"half_stroke_mm", scene.drive.halfStroke * 1e3},
                         {"throw_number", throwNumber},
                         {"speed_mm_s", speed->mean * 1e3},
                         {"least_mm_s", speed->least * 1e3},
                         {"most_mm_s", speed->most * 1e3}});
    }
    console.emit({{"part", scene.part->name}, {"engine", (*engine)->name()}, {"rows", table}});
    return ExitCode::ok;
}

}  // namespace

void addSweepCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    options->part.part = "cuboid";
    Command command =
        addCommand(program, invocation, "sweep",
                   "Conveying speed of a part on a flat track over the half-stroke, to choose it by.",
                   "trapwright sweep --part cuboid --from 0.4 --to 1.2 --step 0.02",
                   [options](const Console& console) { return run(*options, console); });
    constexpr double kLeast = 0.001;  // [mm]
    constexpr double kMost = 10.0;    // [mm]
    command.addOption("--part", options->part.part,
                      "The part: a file, or the name of a bundled one (cuboid)");
    addPartOptions(command, options->part);
    command.addOption("--from", options->from, "First half-stroke in mm (0.4)").range(kLeast, kMost);
    command.addOption("--to", options->to, "Last half-stroke in mm (1.2)").range(kLeast, kMost);
    command.addOption("--step", options->step, "Between two of them in mm (0.02)").range(kLeast, kMost);
    command.addOption("--frequency", options->frequency, "Of the vibration in Hz (50)").range(1.0, 1000.0);
    command.addOption("--angle", options->angle, "Of the vibration in degrees (12)").range(0.1, 89.0);
    constexpr double kSteepest = static_cast<float>(track::kSteepestSlope / base::kDegree);  // [deg]
    command.addOption("--slope", options->slope, "Of a track that climbs, in degrees; below 0 it falls (0)")
        .range(-kSteepest, kSteepest);
    command.addOption("--friction", options->friction, "Static and kinetic (0.5)").range(0.0, 2.0);
    command.addOption("--restitution", options->restitution, "(0.3)").range(0.0, 1.0);
    command.addOption("--engine", options->engine, fmt::format("What simulates ({})", options->engine));
}

}  // namespace trapwright::app
