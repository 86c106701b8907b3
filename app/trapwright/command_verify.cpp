#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/trapwright/command.h"
#include "app/trapwright/engine_agreement.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/work_display.h"
#include "core/verify/verify.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string engine = engines::registry().reference().name;
    std::string filter;
    bool withoutAgreement = false;
    double step = 0.0;  // [ms]; 0: the engine's own
    AgreementOptions agreement;
};

// The reference is what the other is held against, and the certifying mode is too slow for so many trials.
bool wantsAgreement(const Options& options, const trial::EngineKind& kind) {
    return kind.role != trial::EngineRole::reference && kind.role != trial::EngineRole::certifying &&
           !options.withoutAgreement &&
           std::string_view("agreement").find(options.filter) != std::string_view::npos;
}

// The kind, its engines at this step of simulated time unless they are told another one. [s]
trial::EngineKind atStep(trial::EngineKind kind, double step) {
    if (step <= 0.0) return kind;
    kind.make = [make = kind.make, step](trial::EngineOptions options) {
        if (options.step <= 0.0) options.step = step;
        return make(options);
    };
    return kind;
}

// Prints the cases' rows as they come.
Attempt<nlohmann::ordered_json> runCases(const trial::EngineKind& kind, const std::string& filter,
                                         const Console& console) {
    constexpr const char* kRow = "{:<48} {:<40} {:<40} {}\n";
    base::RunControl control;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    {
        WorkWatch watch;
        watch.progress = [&control] { return fmt::format("Verifying, {} trials so far", control.done()); };
        watch.interrupted = [control](int) mutable { control.cancel(); };
        WorkDisplay display(console, watch);
        display.print(fmt::format(fmt::runtime(kRow), "Case", "Expected", "Got", "Verdict"));
        verify::runCases(kind, filter, control, [&](const verify::Row& row) {
            display.print(fmt::format(fmt::runtime(kRow), row.name, row.expected, row.got,
                                      row.passed ? "pass" : "FAIL"));
            rows.push_back(
                {{"case", row.name}, {"expected", row.expected}, {"got", row.got}, {"passed", row.passed}});
        });
    }
    if (control.cancelled()) return Failure{ExitCode::interrupted, "Interrupted; the table is not complete."};
    return rows;
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    // What learns is what has to agree.
    auto kind = findEngine(engines::registry().nameFor(options.engine, trial::EngineUse::learning));
    if (!kind) return kind.error();
    const trial::EngineKind judged = atStep(*kind, options.step * 1e-3);
    std::string names;
    bool anyCase = false;
    for (const verify::Case& one : verify::allCases()) {
        anyCase = anyCase || one.name.find(options.filter) != std::string::npos;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", one.name);
    }
    const bool agreement = wantsAgreement(options, *kind);
    if (!anyCase && !agreement) {
        return Failure{ExitCode::usage,
                       fmt::format("--case {}: no case has that in its name. The cases are: {}; "
                                   "with --engine {} also agreement.",
                                   options.filter, names, engines::registry().quick().name)};
    }

    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    if (anyCase) {
        auto done = runCases(judged, options.filter, console);
        if (!done) return done.error();
        rows = *done;
    }
    const auto failed =
        std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row["passed"]; });
    bool passed = failed == 0;
    if (anyCase) {
        console.print(fmt::format("{} of {} rows pass with {}\n",
                                  rows.size() - static_cast<std::size_t>(failed), rows.size(), kind->name));
    }
    nlohmann::ordered_json answer = {{"engine", kind->name},
                                     {"step_ms", judged.make({})->step() * 1e3},
                                     {"passed", passed},
                                     {"rows", rows}};
    if (agreement) {
        auto table = runAgreement(judged, options.agreement, console);
        if (!table) return table.error();
        passed = passed && (*table)["passed"].get<bool>();
        answer["passed"] = passed;
        answer["agreement"] = *table;
    }
    console.emit(answer);
    return passed ? ExitCode::ok : ExitCode::no;
}

std::string describeEngines() {
    const trial::EngineRegistry& all = engines::registry();
    std::string text =
        fmt::format("{0} (default); {1} or {2}, which is held against {0} as well (case agreement)",
                    all.reference().name, all.quick().name, trial::kHybrid);
    for (const trial::EngineKind& kind : all.kinds())
        if (kind.role == trial::EngineRole::certifying)
            text += fmt::format("; or {}: {}", kind.name, kind.about);
    return text;
}

}  // namespace

void addVerifyCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command =
        addCommand(program, invocation, "verify",
                   "Runs an engine against known physics: case, expected, got, verdict. Exit code 1 if "
                   "any case fails.",
                   fmt::format("trapwright verify --engine {} --case ridge", options->engine),
                   [options](const Console& console) { return run(*options, console); });
    command.addOption("--engine", options->engine, describeEngines());
    command.addOption("--case", options->filter, "Only the cases with this in their name");
    command.addFlag("--no-agreement", options->withoutAgreement, "Leave out the case agreement");
    command
        .addOption("--trials", options->agreement.trials,
                   "Of each part on each track, in each engine, of the case agreement (1000)")
        .range(1, 10000);
    command
        .addOption(
            "--step", options->step,
            "Of simulated time in ms, of this engine alone: the reference keeps its own (each engine's own)")
        .range(1e-4, 2.0);
    command.addOption("--threads", options->agreement.threads,
                      "Threads of the case agreement (default: all processors)");
}

}  // namespace trapwright::app
