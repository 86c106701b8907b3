#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/trapwright/command.h"
#include "app/trapwright/engine_agreement.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/work_display.h"
#include "core/verify/verify.h"
#include "core/workflow/study_engines.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string engine = "simbody";
    std::string filter;
    bool withoutAgreement = false;
    AgreementOptions agreement;
};

// The reference is what the other is held against, and the certifying mode is too slow for so many trials.
bool wantsAgreement(const Options& options) {
    return options.engine == "native" && !options.withoutAgreement &&
           std::string_view("agreement").find(options.filter) != std::string_view::npos;
}

// Prints the cases' rows as they come.
Attempt<nlohmann::ordered_json> runCases(const EngineFactory& factory, const std::string& filter,
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
        verify::runCases(factory, filter, control, [&](const verify::Row& row) {
            display.print(fmt::format(fmt::runtime(kRow), row.name, row.expected, row.got,
                                      row.passed ? "pass" : "FAIL"));
            rows.push_back(
                {{"case", row.name}, {"expected", row.expected}, {"got", row.got}, {"passed", row.passed}});
        });
    }
    if (control.cancelled()) return Failure{ExitCode::interrupted, "Interrupted; the table is not complete."};
    return rows;
}

Attempt<ExitCode> run(Options options, const Console& console) {
    // What learns is what has to agree.
    options.engine = workflow::engineFor(options.engine, workflow::EngineUse::learning);
    auto factory = findEngine(options.engine);
    if (!factory) return factory.failure();
    std::string names;
    bool anyCase = false;
    for (const verify::Case& one : verify::allCases()) {
        anyCase = anyCase || one.name.find(options.filter) != std::string::npos;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", one.name);
    }
    const bool agreement = wantsAgreement(options);
    if (!anyCase && !agreement) {
        return Failure{ExitCode::usage,
                       fmt::format("--case {}: no case has that in its name. The cases are: {}; "
                                   "with --engine native also agreement.",
                                   options.filter, names)};
    }

    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    if (anyCase) {
        auto done = runCases(*factory, options.filter, console);
        if (!done) return done.failure();
        rows = *done;
    }
    const auto failed =
        std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row["passed"]; });
    bool passed = failed == 0;
    if (anyCase) {
        console.print(fmt::format("{} of {} rows pass with {}\n",
                                  rows.size() - static_cast<std::size_t>(failed), rows.size(),
                                  options.engine));
    }
    nlohmann::ordered_json answer = {{"engine", options.engine}, {"passed", passed}, {"rows", rows}};
    if (agreement) {
        auto table = runAgreement(options.agreement, console);
        if (!table) return table.failure();
        passed = passed && (*table)["passed"].get<bool>();
        answer["passed"] = passed;
        answer["agreement"] = *table;
    }
    console.emit(answer);
    return passed ? ExitCode::ok : ExitCode::no;
}

}  // namespace

void addVerifyCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command =
        addCommand(program, invocation, "verify",
                   "Runs an engine against known physics: case, expected, got, verdict. Exit code 1 if "
                   "any case fails.",
                   "trapwright verify --engine simbody --case ridge",
                   [options](const Console& console) { return run(*options, console); });
    command.addOption(
        "--engine", options->engine,
        "simbody (default); native or hybrid, which is held against simbody as well (case agreement); or "
        "simbody-certifying: the continuous contact law under an error-controlled integrator, some hundred "
        "times slower");
    command.addOption("--case", options->filter, "Only the cases with this in their name");
    command.addFlag("--no-agreement", options->withoutAgreement, "Leave out the case agreement");
    command
        .addOption("--trials", options->agreement.trials,
                   "Of each part on each track, in each engine, of the case agreement (1000)")
        .range(1, 10000);
    command.addOption("--threads", options->agreement.threads,
                      "Threads of the case agreement (default: all processors)");
}

}  // namespace trapwright::app
