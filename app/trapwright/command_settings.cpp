#include <memory>
#include <nlohmann/json.hpp>

#include "app/trapwright/command.h"
#include "app/trapwright/study_access.h"

namespace trapwright::app {

namespace {

Attempt<ExitCode> run(const std::string& path, const Console& console) {
    const auto file = store::StudyFile::openReadOnly(path);
    if (!file) return Failure{ExitCode::badInput, file.error().message};
    const auto settings = file->loadSettings();
    if (!settings) return Failure{ExitCode::badInput, settings.error().message};
    const std::string json = study::toJson(*settings);
    console.print(json + "\n");
    console.emit(nlohmann::ordered_json::parse(json));
    return ExitCode::ok;
}

}  // namespace

void addSettingsCommand(CLI::App& program, Invocation& invocation) {
    const auto path = std::make_shared<std::string>();
    Command command =
        addCommand(program, invocation, "settings",
                   "Prints a study's settings as JSON, which `new --settings` and `evolve --settings` take.",
                   "trapwright settings cuboid.trap > settings.json",
                   [path](const Console& console) { return run(*path, console); });
    command.addOption("STUDY", *path, "The study's file").required();
}

}  // namespace trapwright::app
