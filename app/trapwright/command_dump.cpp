#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/study_access.h"
#include "core/store/compare.h"

namespace trapwright::app {

namespace {

/// One line each, as a list.
void appendLines(std::string_view lines, nlohmann::ordered_json& list) {
    while (!lines.empty()) {
        const std::size_t end = lines.find('\n');
        list.push_back(lines.substr(0, end));
        lines.remove_prefix(end == std::string_view::npos ? lines.size() : end + 1);
    }
}

struct Options {
    std::string study;
    std::optional<std::string> compare;
    bool checks = false;
};

Attempt<ExitCode> compare(const store::StudyFile& study, const Options& options, const Console& console) {
    const auto other = store::StudyFile::openReadOnly(*options.compare);
    if (!other) return Failure{ExitCode::badInput, other.error().message};
    const auto difference = store::findDifference(study, *other);
    if (!difference) return Failure{ExitCode::badInput, difference.error().message};
    console.print(difference->empty() ? "The same designs and scores.\n"
                                      : "Different: " + *difference + ".\n");
    console.emit(
        {{"study", options.study}, {"compared_with", *options.compare}, {"difference", *difference}});
    return difference->empty() ? ExitCode::ok : ExitCode::no;
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    const auto file = store::StudyFile::openReadOnly(options.study);
    if (!file) return Failure{ExitCode::badInput, file.error().message};
    if (options.compare) return compare(*file, options, console);
    if (options.checks) {
        const auto lines = store::dumpChecks(*file);
        if (!lines) return Failure{ExitCode::badInput, lines.error().message};
        console.print(*lines);
        const auto checks = file->loadChecks();
        if (!checks) return Failure{ExitCode::badInput, checks.error().message};
        console.emit({{"study", options.study}, {"checks", toJson(*checks)}});
        return ExitCode::ok;
    }
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const auto dumped = store::dumpIndividuals(*file, [&](std::string_view lines) {
        console.print(lines);
        if (console.json()) appendLines(lines, list);
    });
    if (!dumped) return Failure{ExitCode::badInput, dumped.error().message};
    console.emit({{"study", options.study}, {"individuals", list}});
    return ExitCode::ok;
}

}  // namespace

void addDumpCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "dump",
        "Prints designs and scores of every individual, one line each. Equal runs give equal lines.",
        "trapwright dump one.trap > one.txt\n  trapwright dump one.trap --compare two.trap",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->study, "The study's file").required();
    command.addFlag("--checks", options->checks,
                    "Instead, what the reference engine made of each generation's winner (engine hybrid)");
    command.addOption("--compare", options->compare,
                      "Another study: tells where the two first differ; exit code 1 if they do");
}

}  // namespace trapwright::app
