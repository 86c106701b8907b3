#include "app/trapwright/bench_run.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>

#include "app/trapwright/json_records.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/bench/benchmark.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

/// The benchmark's table as text: its head, and one line per scene and engine.
std::string benchHeader(const bench::Plan& plan);
std::string benchRow(const std::string& scene, const bench::Measurement& measured);

/// The same line for machines. Where the engine cannot do the scene, "problem" says why and all else is left
/// out; "shares" is null where it does not tell them.
nlohmann::ordered_json benchRowToJson(const std::string& scene, const bench::Measurement& measured);

/// Hundreds of times slower than the others: timed only if named.
bool isSlow(const trial::EngineKind& kind) {
    return kind.role == trial::EngineRole::certifying;
}

template <class Named>
std::string listNames(std::span<const Named> items) {
    std::string names;
    for (const Named& item : items)
        names += (names.empty() ? "" : ", ") + item.name;
    return names;
}

std::vector<std::string> splitAtCommas(const std::string& text) {
    std::vector<std::string> names;
    std::istringstream stream(text);
    for (std::string name; std::getline(stream, name, ',');)
        names.push_back(name);
    return names;
}

Attempt<std::vector<bench::Scene>> chooseScenes(const std::string& filter) {
    auto scenes = bench::makeScenes();
    if (!scenes) return Failure{ExitCode::badInput, scenes.error().message};
    const std::string names = listNames(std::span<const bench::Scene>(*scenes));
    std::erase_if(scenes.value(),
                  [&](const bench::Scene& scene) { return scene.name.find(filter) == std::string::npos; });
    if (scenes->empty()) {
        return Failure{
            ExitCode::usage,
            fmt::format("--scene {}: no scene has that in its name. The scenes are: {}.", filter, names)};
    }
    return std::move(scenes).value();
}

constexpr const char* kColumns = "{:<15} {:<12} {:>7} {:>14} {:>8} {:>9} {:>12} {:>9} {:>9}   {}\n";

std::string describeShares(const trial::Costs& costs) {
    const double total = costs.total();
    if (total <= 0.0) return "not told";
    return fmt::format("{:>3.0f} {:>3.0f} {:>3.0f} %", 100.0 * costs.detection / total,
                       100.0 * costs.law / total, 100.0 * costs.integration / total);
}

nlohmann::ordered_json sharesToJson(const trial::Costs& costs) {
    const double total = costs.total();
    if (total <= 0.0) return nullptr;
    return {{"detection", costs.detection / total},
            {"law", costs.law / total},
            {"integration", costs.integration / total}};
}

std::string benchHeader(const bench::Plan& plan) {
    return fmt::format(
               "{} trials a scene, median of {} repeats in turns, one thread, CPU time of the process\n",
               plan.trials, plan.repeats) +
           fmt::format(kColumns, "Scene", "Engine", "Step ms", "Trials/s core", "us/step", "Steps",
                       "To the first", "Finished", "Success", "Detection, law, integration");
}

std::string benchRow(const std::string& scene, const bench::Measurement& measured) {
    if (!measured.problem.empty())
        return fmt::format("{:<15} {:<12} cannot: {}\n", scene, measured.engine, measured.problem);
    const study::TrialCounts& counts = measured.counts;
    return fmt::format(kColumns, scene, measured.engine, fmt::format("{:g}", 1e3 * measured.step),
                       fmt::format("{:.1f}", 1.0 / measured.secondsPerTrial()),
                       fmt::format("{:.3f}", 1e6 * measured.secondsPerStep()),
                       fmt::format("{:.0f}", measured.stepsPerTrial()),
                       fmt::format("{:.2f} x", measured.ratio),
                       fmt::format("{:.1f} %", 100.0 * counts.tally.finished() / counts.tally.trials()),
                       fmt::format("{:.1f} %", 100.0 * counts.tally.success / counts.tally.trials()),
                       describeShares(measured.costs));
}

nlohmann::ordered_json benchRowToJson(const std::string& scene, const bench::Measurement& measured) {
    nlohmann::ordered_json row = {{"scene", scene}, {"engine", measured.engine}};
    if (!measured.problem.empty()) {
        row["problem"] = measured.problem;
        return row;
    }
    const study::TrialCounts& counts = measured.counts;
    row.update({{"step_ms", 1e3 * measured.step},
                {"trials", counts.tally.trials()},
                {"trials_per_second_per_core", 1.0 / measured.secondsPerTrial()},
                {"cpu_seconds_per_trial", measured.secondsPerTrial()},
                {"cpu_microseconds_per_step", 1e6 * measured.secondsPerStep()},
                {"steps_per_trial", measured.stepsPerTrial()},
                {"ratio_to_first", measured.ratio},
                {"cpu_seconds", measured.cpuSeconds},
                {"finished", shareToJson(counts.tally.finished(), counts.tally.trials())},
                {"oriented", shareToJson(counts.tally.success, counts.tally.trials())},
                {"shares", sharesToJson(measured.costs)}});
    return row;
}

}  // namespace

void addBenchOptions(Command command, BenchOptions& options) {
    command.addOption("--trials", options.trials, "Of each scene and repeat (200)").range(1, 1000000);
    command.addOption("--repeats", options.repeats, "How often the engines take turns; medians count (3)")
        .range(1, 1000);
    command.addOption("--scene", options.filter, "Only the scenes with this in their name");
    command.addOption("--step", options.step, "Of simulated time in ms (each engine's own)").range(1e-4, 2.0);
    std::vector<trial::EngineKind> slow;
    std::ranges::copy_if(engines::registry().kinds(), std::back_inserter(slow), isSlow);
    command.addOption("--engine", options.engines,
                      fmt::format("Engines side by side: A,B, {} for the two that it stands for, or "
                                  "\"all\", which leaves {} out (all)",
                                  trial::kHybrid, listNames(std::span<const trial::EngineKind>(slow))));
}

Attempt<std::vector<trial::EngineKind>> chooseContenders(const std::string& wanted,
                                                         std::span<const trial::EngineKind> known) {
    std::vector<trial::EngineKind> chosen;
    if (wanted == "all") std::ranges::copy_if(known, std::back_inserter(chosen), std::not_fn(isSlow));
    std::vector<std::string> names = splitAtCommas(wanted == "all" ? "" : wanted);
    if (wanted == trial::kHybrid)
        names = {engines::registry().quick().name, engines::registry().reference().name};
    for (const std::string& name : names) {
        const auto found = std::find_if(known.begin(), known.end(), [&](const trial::EngineKind& contender) {
            return contender.name == name;
        });
        if (found == known.end()) {
            return Failure{ExitCode::usage,
                           fmt::format("--engine {}: there is no engine named \"{}\". The engines are: {}.",
                                       wanted, name, listNames(known))};
        }
        chosen.push_back(*found);
    }
    if (chosen.empty()) return Failure{ExitCode::usage, "--engine names no engine."};
    return chosen;
}

Attempt<ExitCode> runBench(const BenchOptions& options, std::span<const trial::EngineKind> known,
                           const Console& console) {
    auto contenders = chooseContenders(options.engines, known);
    if (!contenders) return contenders.error();
    auto scenes = chooseScenes(options.filter);
    if (!scenes) return scenes.error();

    const bench::Plan plan{options.trials, options.repeats, options.step * 1e-3};
    console.print(benchHeader(plan));
    nlohmann::ordered_json table = nlohmann::ordered_json::array();
    for (const bench::Scene& scene : *scenes) {
        base::RunControl control;
        const auto measured = [&] {
            const WorkDisplay display(
                console, watchTrials(scene.name, bench::countAllTrials(plan, contenders->size()), control));
            return bench::runScene(scene, *contenders, plan, control);
        }();
        if (!measured) return describeRunFailure(control, measured.error());
        for (const bench::Measurement& one : *measured) {
            console.print(benchRow(scene.name, one));
            table.push_back(benchRowToJson(scene.name, one));
        }
    }
    console.emit(
        {{"threads", 1}, {"trials", plan.trials}, {"repeats", plan.repeats}, {"measurements", table}});
    return ExitCode::ok;
}

}  // namespace trapwright::app
