#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/learning_run.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/study_options.h"
#include "core/study/standstill.h"
#include "core/study/target.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string study;
    CreationOptions creation;
    SettingOptions settings;
    unsigned threads = 0;
    bool resume = false;
    bool corners = false;
};

/// Keeps in the study that corners are learned from the next generation on.
Attempt<bool> learnCorners(OpenStudy& study, int next) {
    if (study::cornerShareIn(study.settings.evolution, next) > 0.0) return false;  // since before
    if (!study::canLearnInCorners(study.settings, next))
        return Failure{ExitCode::usage,
                       "Corners can be learned where trials vary over an operating box that has some; "
                       "evolution.conditions is nominal, or every range of box is 0."};
    const study::Settings settings = study::learnInCorners(study.settings, next);
    if (const auto changed = study.file.changeSettings(settings); !changed)
        return describeStudyFailure(changed.error(), ExitCode::usage);
    study.settings = settings;
    return true;
}

/// Opens the study that is to go on, with the settings that the user changed kept in it.
Attempt<OpenStudy> openExisting(const Options& options) {
    if (options.creation.given()) {
        return Failure{ExitCode::usage,
                       fmt::format("The study {} exists; leave out what belongs to a new one (--preset, "
                                   "--part and the like), or choose another name.",
                                   options.study)};
    }
    auto study = openStudy(options.study, Access::write);
    if (!study) return study;
    const auto count = study->file.generationCount();
    if (!count) return Failure{ExitCode::badInput, count.error().message};
    if (*count > 0 && !options.resume) {
        return Failure{ExitCode::usage,
                       fmt::format("The study {} has {} generations already. Go on with it by --resume, "
                                   "or choose another name for a new one.",
                                   options.study, *count)};
    }
    if (auto changed = changeSettings(*study, options.settings); !changed) return changed.error();
    if (options.corners) {
        if (auto changed = learnCorners(*study, *count); !changed) return changed.error();
    }
    return study;
}

Attempt<OpenStudy> openOrCreate(const Options& options, const Console& console) {
    std::error_code failure;
    const bool exists = std::filesystem::exists(options.study, failure);
    if (exists || (options.resume && !options.creation.given())) return openExisting(options);
    if (options.corners)
        return Failure{
            ExitCode::usage,
            fmt::format("There is no study {} yet. Learn some generations without --corners first, "
                        "or set evolution.cornerShare and evolution.cornersFrom.",
                        options.study)};
    CreationOptions creation = options.creation;
    creation.threads = options.threads;
    auto file = createStudy(options.study, creation, options.settings, console);
    if (!file) return file.error();
    return loadStudy(std::move(*file));
}

/// The engine that learns, and "winners checked by ...".
std::string describeEngines(const OpenStudy& study, const study::StudyInputs& inputs) {
    const auto* reference = engines::registry().referenceFor(study.settings.simulation.engine);
    return inputs.engine->name() + (reference != nullptr ? ", winners checked by " + reference->name : "");
}

/// "F_D 0.000 and F_O 1.467": of what counts and depends on trials.
std::string describeAttainable(const part::Part& part, const study::Settings& settings) {
    const std::vector<objectives::Score> attainable =
        objectives::listAttainable(study::makeTask(settings, part));
    std::vector<std::string> texts;
    for (const objectives::Objective* objective : study::summedObjectives(settings.evolution)) {
        if (!objective->isNoisy) continue;
        // Readers of the paper know the units of its scores.
        const bool hasUnit = !objective->isDetail || objective->isSuccess;
        for (const objectives::Score& score : attainable)
            if (score.key == objective->key)
                texts.push_back(fmt::format("{} {}{}", objective->symbol,
                                            objectives::shown(*objective, score.value),
                                            hasUnit ? fmt::format(" {}", objective->unit) : ""));
    }
    return fmt::format("{}", fmt::join(texts, " and "));
}

/// "0.3 ms (automatic)"
std::string describeStep(const study::Settings& settings) {
    return fmt::format("{:g} ms{}", study::chooseLearningStep(settings) * 1e3,
                       settings.evolution.learningStep > 0.0 ? "" : " (automatic)");
}

/// A line; empty where nothing is wanted.
std::string describeWanted(const OpenStudy& study) {
    if (!study.settings.target.isSet()) return "";
    return fmt::format("Parts shall end {}.\n", study::describeTarget(study.settings, *study.part));
}

std::string describeStart(const OpenStudy& study, const study::StudyInputs& inputs) {
    const study::EvolutionSettings& evolution = study.settings.evolution;
    return fmt::format(
        "Study {}: part {} (symmetry {}), {} individuals x {} trials, seed {}, engine {}, step {}, threads "
        "{}\n"
        "{}A perfect feeder scores {}.\n{}",
        study.file.path().string(), study.part->name, study.part->symmetry.name, evolution.populationSize,
        evolution.trialsPerEvaluation, evolution.seed, describeEngines(study, inputs),
        describeStep(study.settings), inputs.threads, describeWanted(study),
        describeAttainable(*study.part, study.settings), learningHeading(inputs.settings.evolution));
}

std::string_view endName(study::LearningEnd end) {
    switch (end) {
        case study::LearningEnd::completed:
            return "completed";
        case study::LearningEnd::stopped:
            return "stopped";
        case study::LearningEnd::cancelled:
            return "cancelled";
    }
    return "";
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto study = openOrCreate(options, console);
    if (!study) return study.error();
    auto inputs = makeInputs(*study, std::nullopt, trial::EngineUse::learning, options.threads);
    if (!inputs) return inputs.error();
    console.print(describeStart(*study, *inputs));

    auto ran = runLearning(study->file, *inputs, console, std::nullopt);
    if (!ran) return ran.error();
    const workflow::LearningReport& report = ran->report;
    const auto summaries = study->file.loadSummaries();
    if (!summaries) return Failure{ExitCode::badInput, summaries.error().message};
    const double rate = report.seconds > 0.0 ? static_cast<double>(report.trials) / report.seconds : 0.0;
    console.print(fmt::format("{}: {} generations in {}, {} trials in {:.1f} s ({:.1f}/s)\n",
                              ran->interrupted ? "Stopped" : "Done", summaries->size(), options.study,
                              report.trials, report.seconds, rate));
    const std::optional<int> standstill = study::findStandstill(*summaries);
    if (standstill) {
        console.print(fmt::format(
            "Nothing was gained since generation {}. What is left to gain is in the ways in which "
            "parts end: trapwright export {} track.json; trapwright track track.json --part {}\n",
            *standstill, options.study, study->settings.part.file));
    }
    const auto* reference = engines::registry().referenceFor(study->settings.simulation.engine);
    const auto unchecked = study->file.loadUncheckedWinners();
    if (!unchecked) return Failure{ExitCode::badInput, unchecked.error().message};
    if (reference != nullptr && !unchecked->empty())
        console.print(
            fmt::format("{} winners are not checked yet; evolve --resume does that.\n", unchecked->size()));
    if (ran->interrupted && !console.json())
        console.note(fmt::format("Go on with: trapwright evolve {} --resume", options.study));

    const auto checks = study->file.loadChecks();
    if (!checks) return Failure{ExitCode::badInput, checks.error().message};
    nlohmann::ordered_json generations = nlohmann::ordered_json::array();
    for (const study::GenerationSummary& summary : *summaries)
        generations.push_back(toJson(summary));
    nlohmann::ordered_json document = {
        {"study", options.study},
        {"engine", inputs->engine->name()},
        {"nothing_gained_since", standstill ? nlohmann::ordered_json(*standstill) : nlohmann::ordered_json()},
        {"reference_engine",
         reference != nullptr ? nlohmann::ordered_json(reference->name) : nlohmann::ordered_json()},
        {"learning_step_ms", study::chooseLearningStep(study->settings) * 1e3},
        {"threads", inputs->threads},
        {"end", endName(report.end)},
        {"trials", report.trials},
        {"seconds", report.seconds},
        {"trials_per_second", rate},
        {"generations", generations},
        {"checks", toJson(*checks)}};
    addRemadeTrials(*inputs, document);
    console.emit(document);
    return ran->interrupted ? ExitCode::interrupted : ExitCode::ok;
}

}  // namespace

void addEvolveCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "evolve",
        "Learns a track: generation after generation, each saved in the study as soon as it is complete.\n"
        "Ctrl-C once stops after the generation, twice at once.",
        "trapwright evolve cuboid.trap --preset cuboid --population 40 --trials 20 --generations 40\n"
        "  trapwright evolve cuboid.trap --resume --generations 80\n"
        "  trapwright evolve cuboid.trap --resume --corners",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->study, "The study's file; made if it does not exist").required();
    command.addFlag("--resume", options->resume, "Go on where the study stopped, bit for bit");
    command.addFlag("--corners", options->corners,
                    "From the next generation on learn in corners of the operating box, too: three of five "
                    "trials, for 20 generations at least");
    addSettingOptions(command, options->settings);
    command.addOption("--threads", options->threads, "Threads (default: all processors)");
    addCreationOptions(command, options->creation);
}

}  // namespace trapwright::app
