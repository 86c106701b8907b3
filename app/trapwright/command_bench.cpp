#include <fmt/format.h>
#include <time.h>

#include <array>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/trapwright/command.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/resource_tracks.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/track_trials.h"
#include "app/trapwright/work_display.h"
#include "core/study/evaluator.h"
#include "core/track/track_file.h"
#include "core/verify/scenes.h"

namespace trapwright::app {

namespace {

struct Options {
    int trials = 200;
    double step = 0.0;  // [ms]
    std::string engine = "simbody";
    std::string filter;
};

/// A track with the paper's cuboid, to be timed on.
struct Scene {
    std::string name;
    std::shared_ptr<const track::Track> track;
    std::optional<base::Quaternion> expected;
    double lift = 0.0;  // of the start, where the lead-in is not the highest place around [m]
};

struct Timing {
    TrialCounts counts;
    double cpuSeconds = 0.0;
    double step = 0.0;  // [s]

    [[nodiscard]] double steps() const { return counts.simulatedTime / step; }
    [[nodiscard]] double secondsPerTrial() const { return cpuSeconds / counts.trials; }
};

/// What this process has computed so far: on a busy machine the wall clock would measure the others too. [s]
double readCpuClock() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Attempt<std::vector<Scene>> makeScenes() {
    const auto learned = track::readTrackFile(findResourceTrack("cuboid_track.json"));
    if (!learned) return Failure{ExitCode::badInput, learned.error().message};
    constexpr double kAboveHills = 8e-3;
    return std::vector<Scene>{{"cuboid flat", verify::makeFlat(), std::nullopt, 0.0},
                              {"cuboid rough", verify::makeRough(), std::nullopt, kAboveHills},
                              {"cuboid learned", std::make_shared<const track::Track>(learned->track),
                               learned->expectedOrientation, 0.0}};
}

Attempt<Timing> timeScene(const Scene& scene, const trial::Engine& engine, const Options& options,
                          const Console& console) {
    const study::Settings settings;
    const auto part = verify::makePaperCuboid();
    trial::TrialBatch batch = makeTrackBatch(scene.track, part, settings.simulation, 1, options.trials);
    for (trial::TrialSpec& trial : batch.trials)
        trial.start.pose.position.z() += scene.lift;

    base::RunControl control;
    Timing timing;
    timing.step = options.step > 0.0 ? options.step * 1e-3 : engine.defaultStep();
    const auto outcomes = [&] {
        const WorkDisplay display(console, watchTrials(scene.name, options.trials, control));
        const double begin = readCpuClock();
        auto result = study::runTrials(engine, {&batch, 1}, control);
        timing.cpuSeconds = readCpuClock() - begin;
        return result;
    }();
    if (!outcomes) return describeRunFailure(control, outcomes.error());
    timing.counts =
        countTrials(outcomes->front(), part->symmetry, scene.expected, settings.validation.tolerance);
    return timing;
}

std::string describeTiming(const Scene& scene, const Timing& timing) {
    const TrialCounts& counts = timing.counts;
    return fmt::format("{:<16} {:>6} {:>12.4f} {:>14.3f} {:>12.0f} {:>14.1f} {:>9.1f} % {:>8.1f} %\n",
                       scene.name, counts.trials, timing.secondsPerTrial(),
                       1e6 * timing.cpuSeconds / timing.steps(), timing.steps() / counts.trials,
                       1.0 / timing.secondsPerTrial(), 100.0 * counts.finished / counts.trials,
                       100.0 * counts.oriented / counts.trials);
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto engine = makeEngine(options.engine, {1, options.step * 1e-3});
    if (!engine) return engine.failure();
    auto scenes = makeScenes();
    if (!scenes) return scenes.failure();
    std::string names;
    for (const Scene& scene : *scenes)
        names += (names.empty() ? "" : ", ") + scene.name;
    std::erase_if(*scenes,
                  [&](const Scene& scene) { return scene.name.find(options.filter) == std::string::npos; });
    if (scenes->empty()) {
        return Failure{ExitCode::usage,
                       fmt::format("--scene {}: no scene has that in its name. The scenes are: {}.",
                                   options.filter, names)};
    }
    const double step = options.step > 0.0 ? options.step : (*engine)->defaultStep() * 1e3;
    console.print(
        fmt::format("Engine {}, step {:g} ms, one thread, CPU time of the process\n"
                    "{:<16} {:>6} {:>12} {:>14} {:>12} {:>14} {:>11} {:>10}\n",
                    options.engine, step, "Scene", "Trials", "s per trial", "us per step", "steps/trial",
                    "trials/s core", "finished", "oriented"));
    nlohmann::ordered_json table = nlohmann::ordered_json::array();
    for (const Scene& scene : *scenes) {
        auto timing = timeScene(scene, **engine, options, console);
        if (!timing) return timing.failure();
        console.print(describeTiming(scene, *timing));
        const TrialCounts& counts = timing->counts;
        table.push_back({{"scene", scene.name},
                         {"trials", counts.trials},
                         {"cpu_seconds_per_trial", timing->secondsPerTrial()},
                         {"cpu_microseconds_per_step", 1e6 * timing->cpuSeconds / timing->steps()},
                         {"steps_per_trial", timing->steps() / counts.trials},
                         {"trials_per_second_per_core", 1.0 / timing->secondsPerTrial()},
                         {"finished", shareToJson(counts.finished, counts.trials)},
                         {"oriented", shareToJson(counts.oriented, counts.trials)}});
    }
    console.emit({{"engine", options.engine}, {"step_ms", step}, {"threads", 1}, {"scenes", table}});
    return ExitCode::ok;
}

}  // namespace

void addBenchCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = addCommand(program, invocation, "bench",
                                   "What a trial costs on this machine: named scenes, one thread, CPU time.",
                                   "trapwright bench --trials 500 --json",
                                   [options](const Console& console) { return run(*options, console); });
    command.add_option("--trials", options->trials, "Of each scene (200)")->check(CLI::Range(1, 1000000));
    command.add_option("--scene", options->filter, "Only the scenes with this in their name");
    command.add_option("--step", options->step, "Of simulated time in ms (the engine's own)")
        ->check(CLI::Range(1e-4, 2.0));
    command.add_option("--engine", options->engine, "The engine (simbody)");
}

}  // namespace trapwright::app
