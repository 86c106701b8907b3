#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/study_jobs.h"
#include "core/study/tables.h"
#include "core/study/target.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string study;
    std::optional<int> winners;
    std::optional<int> trials;
    std::optional<int> cornerTrials;
    std::optional<std::string> engine;
    std::optional<std::string> conditions;
    unsigned threads = 0;
};

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto study = openStudy(options.study, Access::write);
    if (!study) return study.error();
    auto inputs = makeInputs(*study, options.engine, trial::EngineUse::judging, options.threads);
    if (!inputs) return inputs.error();
    if (const auto taken = takeConditions(options.conditions, inputs->settings); !taken) return taken.error();
    study::ValidationSettings& validation = inputs->settings.validation;
    validation.selectionWinners = options.winners.value_or(validation.selectionWinners);
    validation.selectionTrials = options.trials.value_or(validation.selectionTrials);
    validation.selectionCornerTrials = options.cornerTrials.value_or(validation.selectionCornerTrials);

    auto record = selectAndSave(study->file, *inputs, console);
    if (!record) return record.error();
    if (study->settings.target.isSet())
        console.print(
            fmt::format("Success: parts end {}.\n", study::describeTarget(study->settings, *study->part)));
    if (record->box) console.print("Conditions vary over the operating box.\n");
    console.print(study::formatSelection(*record));
    nlohmann::ordered_json document = {{"study", options.study}, {"selection", toJson(*record)}};
    if (record->box) {
        const study::SelectionEntry& best = record->entries.front();
        auto individual = study->file.loadIndividual(best);
        if (!individual) return Failure{ExitCode::badInput, individual.error().message};
        const workflow::TrialsRequest request{workflow::TrialKind::selection, {best, std::move(*individual)}};
        if (const auto added = addSlices(*study, request, console, document); !added) return added.error();
    }
    addRemadeTrials(*inputs, document);
    console.emit(document);
    return ExitCode::ok;
}

}  // namespace

void addSelectCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command =
        addCommand(program, invocation, "select",
                   "Simulates the highest winners of all generations many times each and ranks them.",
                   "trapwright select cuboid.trap --winners 10 --trials 1000",
                   [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->study, "The study's file").required();
    command.addOption("--winners", options->winners,
                      "How many of the highest winners (default: as in the study)");
    command.addOption("--trials", options->trials, "Trials of each (default: as in the study)");
    command.addOption("--corner-trials", options->cornerTrials,
                      "More of each in corners of the operating box (default: as in the study)");
    addConditionsOption(command, options->conditions);
    command.addOption("--engine", options->engine, "What simulates (default: as in the study)");
    command.addOption("--threads", options->threads, "Threads (default: all processors)");
}

}  // namespace trapwright::app
