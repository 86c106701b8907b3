#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/print_options.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/study/tables.h"
#include "core/workflow/judging.h"

namespace trapwright::app {

namespace {

constexpr double kSquareMillimetre = 1e-6;  // [m^2]

struct Options {
    std::string study;
    IndividualChoice choice;
    study::MendingPlan plan;
    PrintRequest print;
    std::optional<int> selectionTrials;
    std::optional<int> cornerTrials;
    std::optional<std::string> engine;
    std::optional<std::string> conditions;
    unsigned threads = 0;
};

Attempt<ExitCode> run(const Options& options, const Console& console) {
    study::MendingPlan plan = options.plan;
    const auto means = findPrintMeans(options.print);
    if (!means) return means.error();
    plan.limits = means->limits;
    if (const auto checked = plan.check(); !checked) return Failure{ExitCode::usage, checked.error().message};
    auto study = openStudy(options.study, Access::write);
    if (!study) return study.error();
    const auto individual = findIndividual(study->file, options.choice);
    if (!individual) return individual.error();
    auto inputs = makeInputs(*study, options.engine, trial::EngineUse::learning, options.threads);
    if (!inputs) return inputs.error();
    if (const auto taken = takeConditions(options.conditions, inputs->settings); !taken) return taken.error();
    study::ValidationSettings& validation = inputs->settings.validation;
    validation.selectionTrials = options.selectionTrials.value_or(validation.selectionTrials);
    validation.selectionCornerTrials = options.cornerTrials.value_or(validation.selectionCornerTrials);

    const auto unprintable =
        study::measureUnprintable(inputs->settings.track, individual->record.design, plan.limits);
    if (!unprintable) return Failure{ExitCode::badInput, unprintable.error().message};
    nlohmann::ordered_json document = {
        {"study", options.study},
        {"mended", {{"generation", individual->generation}, {"individual", individual->individual}}},
        {"unprintable_mm2", *unprintable / kSquareMillimetre}};
    if (*unprintable <= 0.0) {
        console.print(
            fmt::format("All of generation {}, individual {} can be printed: there is nothing to mend.\n",
                        individual->generation, individual->individual));
        console.emit(document);
        return ExitCode::ok;
    }
    const base::RunControl control;
    const auto report = [&] {
        const WorkDisplay display(
            console, watchTrials("Mending", workflow::countMendingTrials(inputs->settings, plan), control));
        return workflow::mendAndSave(study->file, *inputs, *individual, plan, {}, control);
    }();
    if (!report) return toFailure(report.error(), study->file);
    noteRemadeTrials(*inputs, console);
    console.print(fmt::format(
        "{:.2f} mm2 of generation {}, individual {} cannot be printed. Mended {} times; of {} all can be "
        "printed now: generation {}.\nThe best of them beside what they come of:\n{}"
        "The final track is generation {}, individual {} now.\n",
        *unprintable / kSquareMillimetre, individual->generation, individual->individual, plan.variants,
        report->generation.individuals.size(), report->generation.index,
        study::formatSelection(report->selection), report->best.generation, report->best.individual));
    document.update(
        {{"tried", plan.variants},
         {"printable", report->generation.individuals.size()},
         {"best", {{"generation", report->best.generation}, {"individual", report->best.individual}}},
         {"selection", toJson(report->selection)}});
    addRemadeTrials(*inputs, document);
    console.emit(document);
    return ExitCode::ok;
}

}  // namespace

void addMendCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "mend",
        "Changes a learned track a little, many times anew, so that nothing of it is too thin, sharp or "
        "too steep to print, and compares the best with it. They become a generation of the study.",
        "trapwright mend cuboid.trap --printer prusa-mk4",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->study, "The study's file").required();
    addIndividualOptions(command, options->choice);
    command.addOption("--variants", options->plan.variants, "How often it is mended (20)");
    command.addOption("--variant-trials", options->plan.trials, "Trials of each that can be printed (200)");
    command.addOption("--compared", options->plan.compared, "Of the best of them, beside the track (5)");
    command.addOption("--trials", options->selectionTrials,
                      "Trials of each that is compared (default: as in the study)");
    command.addOption("--corner-trials", options->cornerTrials,
                      "More of each in corners of the operating box (default: as in the study)");
    addPrinterOptions(command, options->print);
    addConditionsOption(command, options->conditions);
    command.addOption("--engine", options->engine, "What simulates (default: what the study learns with)");
    command.addOption("--threads", options->threads, "Threads (default: all processors)");
}

}  // namespace trapwright::app
