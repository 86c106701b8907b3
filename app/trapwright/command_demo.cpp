#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/learning_run.h"
#include "app/trapwright/print_options.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/study_options.h"
#include "core/study/pose_weights.h"
#include "core/study/tables.h"
#include "core/study/track_design.h"

namespace trapwright::app {

namespace {

// Small enough that learning, selection and validation end within four minutes on two cores.
constexpr int kPopulation = 40;
constexpr int kTrials = 20;
constexpr double kLearningTime = 140.0;  // [s]
constexpr int kSelectionWinners = 3;

struct Options {
    std::string folder;
    SettingOptions settings;
    double minutes = kLearningTime / 60.0;
    int selectionTrials = 150;
    int trialsPerPose = 100;
    unsigned threads = 0;
};

/// The study of the folder, made there if it is not.
Attempt<OpenStudy> openOrCreate(const Options& options, const std::string& path, const Console& console) {
    std::error_code failure;
    if (std::filesystem::exists(path, failure)) {
        auto study = openStudy(path, Access::write);
        if (!study) return study;
        if (auto changed = changeSettings(*study, options.settings); !changed) return changed.error();
        return study;
    }
    CreationOptions creation;
    creation.preset = "cuboid";
    SettingOptions settings = options.settings;
    settings.population = settings.population.value_or(kPopulation);
    settings.trials = settings.trials.value_or(kTrials);
    auto file = createStudy(path, creation, settings, console);
    if (!file) return file.error();
    return loadStudy(std::move(*file));
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    const std::filesystem::path folder = options.folder;
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) {
        return Failure{ExitCode::cannotWrite,
                       fmt::format("The folder {} cannot be made ({}). Choose another by --out.",
                                   options.folder, failure.message())};
    }
    const std::string path = (folder / "cuboid.trap").string();
    auto study = openOrCreate(options, path, console);
    if (!study) return study.error();
    const auto before = study->file.generationCount();
    if (!before) return Failure{ExitCode::badInput, before.error().message};
    auto inputs = makeInputs(*study, std::nullopt, trial::EngineUse::learning, options.threads);
    if (!inputs) return inputs.error();

    console.print(fmt::format(
        "{} a track for the 4 x 8 x 12 mm cuboid in {}: {} individuals x {} trials, engine {}, {} "
        "threads, for about {:.1f} minutes\n{}",
        *before == 0 ? "Learning" : fmt::format("Going on from generation {} with", *before - 1), path,
        study->settings.evolution.populationSize, study->settings.evolution.trialsPerEvaluation,
        inputs->engine->name(), inputs->threads, options.minutes,
        learningHeading(inputs->settings.evolution)));
    auto learned = runLearning(study->file, *inputs, console, options.minutes * 60.0);
    if (!learned) return learned.error();
    if (learned->interrupted) {
        return Failure{ExitCode::interrupted,
                       fmt::format("Stopped. Go on with: trapwright evolve {} --resume", path)};
    }

    inputs = makeInputs(*study, std::nullopt, trial::EngineUse::judging, options.threads);
    if (!inputs) return inputs.error();
    inputs->settings.validation.selectionWinners = kSelectionWinners;
    inputs->settings.validation.selectionTrials = options.selectionTrials;
    inputs->settings.validation.selectionCornerTrials = options.selectionTrials / 2;
    inputs->settings.validation.trialsPerPose = options.trialsPerPose;
    auto selection = selectAndSave(study->file, *inputs, console);
    if (!selection) return selection.error();
    console.print("\nThe best winners, simulated more often:\n" + study::formatSelection(*selection));
    auto picked = findIndividual(study->file, {});
    if (!picked) return picked.error();
    auto validation = validateAndSave(study->file, *inputs, *picked, std::nullopt, console);
    if (!validation) return validation.error();
    const std::vector<part::PoseGroup> groups = study::weighPoseGroups(*inputs->part, inputs->settings);
    console.print(fmt::format(
        "\nThe track of generation {}, by the pose in which the parts arrive{}:\n{}\n", picked->generation,
        validation->box ? ", each on a feeder with other friction, restitution, stroke and part size" : "",
        study::formatValidation(study::tabulate(*validation, groups))));

    auto track = study::decodeTrack(study->settings.track, picked->record.design);
    if (!track) return Failure{ExitCode::fault, track.error().message};
    const track::TrackFile design{fmt::format("cuboid, generation {}", picked->generation),
                                  std::move(track).value(), validation->goal.shown()};
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const char* name : {"cuboid.stl", "cuboid.3mf"}) {
        const auto exported = workflow::exportTrack(design, {&design.track.solid, 1}, folder / name);
        if (!exported) return toFailure(exported.error());
        console.print(describeExport(exported->front()));
        files.push_back(exported->front().path.string());
    }
    console.emit({{"study", path},
                  {"selection", toJson(*selection)},
                  {"validation", toJson(*validation, *study->part, groups)},
                  {"files", files}});
    return ExitCode::ok;
}

}  // namespace

void addDemoCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "demo",
        "The main job in a few minutes: learns a track for the cuboid, selects, validates and exports it.\n"
        "Goes on with the study if the folder has one.",
        "trapwright demo --out ./trapwright-cuboid",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("--out", options->folder, "The folder for the study and the track").required();
    command.addOption("--minutes", options->minutes, "Time for learning (2.3)").range(0.0, 100000.0);
    command.addOption("--selection-trials", options->selectionTrials, "Of each of the best winners (150)");
    command.addOption("--trials-per-pose", options->trialsPerPose, "Of the validation (100)");
    addSettingOptions(command, options->settings);
    command.addOption("--threads", options->threads, "Threads (default: all processors)");
}

}  // namespace trapwright::app
