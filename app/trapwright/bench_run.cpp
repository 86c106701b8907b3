#include "app/trapwright/bench_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/trapwright/bench_report.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/workflow/study_engines.h"

namespace trapwright::app {

namespace {

/// Hundreds of times slower than the others: timed only if named.
constexpr const char* kCertifying = "simbody-certifying";

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

/// The engines in the order in which they were named; the first is what the others are compared with.
Attempt<std::vector<bench::Contender>> chooseContenders(const std::string& engines,
                                                        std::span<const bench::Contender> known) {
    std::vector<bench::Contender> chosen;
    if (engines == "all") {
        for (const bench::Contender& contender : known)
            if (contender.name != kCertifying) chosen.push_back(contender);
    }
    std::vector<std::string> names = splitAtCommas(engines == "all" ? "" : engines);
    if (engines == "hybrid")
        names = {workflow::engineFor(engines, workflow::EngineUse::learning),
                 *workflow::referenceFor(engines)};
    for (const std::string& name : names) {
        const auto found = std::find_if(known.begin(), known.end(), [&](const bench::Contender& contender) {
            return contender.name == name;
        });
        if (found == known.end()) {
            return Failure{ExitCode::usage,
                           fmt::format("--engine {}: there is no engine named \"{}\". The engines are: {}.",
                                       engines, name, listNames(known))};
        }
        chosen.push_back(*found);
    }
    if (chosen.empty()) return Failure{ExitCode::usage, "--engine names no engine."};
    return chosen;
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

}  // namespace

void addBenchOptions(Command command, BenchOptions& options) {
    command.addOption("--trials", options.trials, "Of each scene and repeat (200)").range(1, 1000000);
    command.addOption("--repeats", options.repeats, "How often the engines take turns; medians count (3)")
        .range(1, 1000);
    command.addOption("--scene", options.filter, "Only the scenes with this in their name");
    command.addOption("--step", options.step, "Of simulated time in ms (each engine's own)").range(1e-4, 2.0);
    command.addOption("--engine", options.engines,
                      fmt::format("Engines side by side: A,B, hybrid for the two that it stands for, or "
                                  "\"all\", which leaves {} out (all)",
                                  kCertifying));
}

std::vector<bench::Contender> listContenders() {
    std::vector<bench::Contender> contenders;
    for (const std::string& name : engineNames()) {
        if (auto factory = findEngine(name)) contenders.push_back({name, *factory});
    }
    return contenders;
}

Attempt<ExitCode> runBench(const BenchOptions& options, std::span<const bench::Contender> known,
                           const Console& console) {
    auto contenders = chooseContenders(options.engines, known);
    if (!contenders) return contenders.failure();
    auto scenes = chooseScenes(options.filter);
    if (!scenes) return scenes.failure();

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
