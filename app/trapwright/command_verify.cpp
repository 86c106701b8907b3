#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/trapwright/command.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/work_display.h"
#include "core/verify/verify.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string engine = "simbody";
    std::string filter;
};

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto factory = findEngine(options.engine);
    if (!factory) return factory.failure();
    std::string names;
    bool any = false;
    for (const verify::Case& one : verify::allCases()) {
        any = any || one.name.find(options.filter) != std::string::npos;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", one.name);
    }
    if (!any) {
        return Failure{ExitCode::usage,
                       fmt::format("--case {}: no case has that in its name. The cases are: {}.",
                                   options.filter, names)};
    }

    constexpr const char* kRow = "{:<48} {:<40} {:<40} {}\n";
    base::RunControl control;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    bool passed = false;
    {
        WorkWatch watch;
        watch.progress = [&control] { return fmt::format("Verifying, {} trials so far", control.done()); };
        watch.interrupted = [control](int) mutable { control.cancel(); };
        WorkDisplay display(console, watch);
        display.print(fmt::format(fmt::runtime(kRow), "Case", "Expected", "Got", "Verdict"));
        passed = verify::runCases(*factory, options.filter, control, [&](const verify::Row& row) {
            display.print(fmt::format(fmt::runtime(kRow), row.name, row.expected, row.got,
                                      row.passed ? "pass" : "FAIL"));
            rows.push_back(
                {{"case", row.name}, {"expected", row.expected}, {"got", row.got}, {"passed", row.passed}});
        });
    }
    if (control.cancelled()) return Failure{ExitCode::interrupted, "Interrupted; the table is not complete."};
    const auto failed =
        std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row["passed"]; });
    console.print(fmt::format("{} of {} rows pass with {}\n", rows.size() - static_cast<std::size_t>(failed),
                              rows.size(), options.engine));
    console.emit({{"engine", options.engine}, {"passed", passed}, {"rows", rows}});
    return passed ? ExitCode::ok : ExitCode::no;
}

}  // namespace

void addVerifyCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    CLI::App& command =
        addCommand(program, invocation, "verify",
                   "Runs an engine against known physics: case, expected, got, verdict. Exit code 1 if "
                   "any case fails.",
                   "trapwright verify --engine simbody --case ridge",
                   [options](const Console& console) { return run(*options, console); });
    command.add_option(
        "--engine", options->engine,
        "simbody (default), or simbody-certifying: the continuous contact law under an error-controlled "
        "integrator, some hundred times slower");
    command.add_option("--case", options->filter, "Only the cases with this in their name");
}

}  // namespace trapwright::app
