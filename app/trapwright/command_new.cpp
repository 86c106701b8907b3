#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/trapwright/command.h"
#include "app/trapwright/study_options.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string study;
    CreationOptions creation;
    SettingOptions settings;
};

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto file = createStudy(options.study, options.creation, options.settings, console);
    if (!file) return file.error();
    const auto settings = file->loadSettings();
    if (!settings) return Failure{ExitCode::badInput, settings.error().message};
    console.print(fmt::format("Made the study {} for the part {}. Learn with: trapwright evolve {}\n",
                              options.study, settings->part.file, options.study));
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
    addCreationOptions(command, options->creation);
    addSettingOptions(command, options->settings);
}

}  // namespace trapwright::app
