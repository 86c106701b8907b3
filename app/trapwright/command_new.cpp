#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/trapwright/command.h"
#include "app/trapwright/program.h"
#include "app/trapwright/study_options.h"
#include "core/workflow/example_studies.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string study;
    std::optional<std::string> example;
    CreationOptions creation;
    SettingOptions settings;
};

/// A copy of a study that comes with Trapwright.
Attempt<store::StudyFile> copyExample(const Options& options) {
    if (options.creation.given() || options.settings.given())
        return Failure{ExitCode::usage,
                       "--example: an example is copied as it is. Leave out what is to be another way; "
                       "`trapwright evolve STUDY --set KEY=VALUE` can change some of it later."};
    const auto example = workflow::findExampleStudy(*options.example);
    if (!example) return Failure{ExitCode::usage, "--example: " + example.error().message};
    if (const auto copied = workflow::copyExample(*example, options.study); !copied)
        return describeCreateFailure(options.study, copied.error());
    auto file = store::StudyFile::open(options.study, kProgram);
    if (!file) return describeStudyFailure(file.error(), ExitCode::badInput);
    return std::move(*file);
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto file = options.example ? copyExample(options)
                                : createStudy(options.study, options.creation, options.settings, console);
    if (!file) return file.error();
    const auto settings = file->loadSettings();
    if (!settings) return Failure{ExitCode::badInput, settings.error().message};
    if (options.example) {
        console.print(fmt::format("Copied the example {} to {}. Look at it with: trapwright validate {}\n",
                                  *options.example, options.study, options.study));
    } else {
        console.print(fmt::format("Made the study {} for the part {}. Learn with: trapwright evolve {}\n",
                                  options.study, settings->part.file, options.study));
    }
    console.emit(
        {{"study", options.study}, {"settings", nlohmann::ordered_json::parse(study::toJson(*settings))}});
    return ExitCode::ok;
}

}  // namespace

void addNewCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(program, invocation, "new", "Makes a study without learning yet.",
                                 "trapwright new clip.trap --part clip.step --material POM --set "
                                 "track.segmentWidth_mm=50",
                                 [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->study, "The study's file, to be made").required();
    command
        .addOption(
            "--example", options->example,
            "Copy a learned study that comes with Trapwright instead: " + workflow::nameExampleStudies())
        .type("EXAMPLE");
    addCreationOptions(command, options->creation);
    addSettingOptions(command, options->settings);
}

}  // namespace trapwright::app
