#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/study_jobs.h"
#include "core/study/pose_weights.h"
#include "core/study/tables.h"
#include "core/study/target.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string study;
    IndividualChoice choice;
    std::optional<int> trials;
    std::optional<double> tolerance;  // [deg]
    std::vector<double> expected;     // w x y z
    std::optional<std::string> engine;
    std::optional<std::string> conditions;
    unsigned threads = 0;
    bool everyPose = false;
};

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto expected = readExpected(options.expected);
    if (!expected) return expected.error();
    auto study = openStudy(options.study, Access::write);
    if (!study) return study.error();
    auto individual = findIndividual(study->file, options.choice);
    if (!individual) return individual.error();
    auto inputs = makeInputs(*study, options.engine, trial::EngineUse::judging, options.threads);
    if (!inputs) return inputs.error();
    if (const auto taken = takeConditions(options.conditions, inputs->settings); !taken) return taken.error();
    study::ValidationSettings& validation = inputs->settings.validation;
    validation.trialsPerPose = options.trials.value_or(validation.trialsPerPose);
    if (options.tolerance) validation.tolerance = *options.tolerance * base::kDegree;

    auto record = validateAndSave(study->file, *inputs, *individual, *expected, console);
    if (!record) return record.error();
    const std::vector<part::PoseGroup> groups = study::weighPoseGroups(*study->part, study->settings);
    console.print(
        fmt::format("Generation {}, individual {}, engine {}; success: finished within {:g} deg of {}{}\n{}",
                    record->generation, record->individual, record->engine, record->tolerance / base::kDegree,
                    study::describeGoal(record->goal, *study->part),
                    record->box ? "; conditions vary over the operating box" : "",
                    study::formatValidation(study::tabulate(*record, groups), options.everyPose)));
    nlohmann::ordered_json document = {{"study", options.study},
                                       {"validation", toJson(*record, *study->part, groups)}};
    workflow::TrialsRequest request{workflow::TrialKind::validation, *individual, {}};
    for (const study::ValidationRow& row : record->rows)
        request.poses.push_back(row.pose);
    if (const auto added = addSlices(*study, request, console, document); !added) return added.error();
    addRemadeTrials(*inputs, document);
    console.emit(document);
    return ExitCode::ok;
}

}  // namespace

void addValidateCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "validate",
        "Success of one track per stable pose of the part: trials T, failures F, success P with its 95 % "
        "Clopper-Pearson bounds. "
        "Poses that look the same are one row.",
        "trapwright validate cuboid.trap --trials 1000",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->study, "The study's file").required();
    addIndividualOptions(command, options->choice);
    command.addOption("--trials", options->trials, "Trials per stable pose (default: as in the study)");
    command.addFlag("--poses", options->everyPose, "Also a row for each of the poses that look the same");
    command.addOption("--tolerance", options->tolerance,
                      "Of the orientation, in degrees (default: as in the study)");
    command
        .addOption(
            "--expected", options->expected,
            "The orientation that counts as success, w x y z (default: what the study wants, or the most "
            "frequent final one)")
        .values(4);
    addConditionsOption(command, options->conditions);
    command.addOption("--engine", options->engine, "What simulates (default: as in the study)");
    command.addOption("--threads", options->threads, "Threads (default: all processors)");
}

}  // namespace trapwright::app
