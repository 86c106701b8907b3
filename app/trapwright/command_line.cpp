#include "app/trapwright/command_line.h"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "app/trapwright/help_formatter.h"
#include "app/trapwright/option_values.h"
#include "app/trapwright/program.h"
#include "core/base/spelling.h"

namespace trapwright::app {

namespace {

std::vector<std::string> listCommandNames(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command :
         program.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> listOptionNames(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    }
    return names;
}

}  // namespace

void buildCommandLine(CLI::App& program, Invocation& invocation) {
    program.formatter(std::make_shared<HelpFormatter>());
    program.footer(
        std::string("`trapwright COMMAND --help` tells a command's options and shows an example.\n\n") +
        kExitCodesText);
    program.set_version_flag("--version", std::string(kProgram), "Print the version and end");
    program.set_help_flag("-h,--help", "Print this help and end");
    program.require_subcommand(1);
    program.failure_message(CLI::FailureMessage::simple);
    for (const auto add :
         {addPartCommand, addMaterialsCommand, addNewCommand, addSettingsCommand, addEvolveCommand,
          addSelectCommand, addValidateCommand, addPhysicalCommand, addExportCommand, addReplayCommand,
          addTrackCommand, addSweepCommand, addVerifyCommand, addBenchCommand, addDemoCommand, addDumpCommand,
          addCompletionCommand}) {
        add(program, invocation);
    }
    nameValueTypes(program);
}

std::string explainParseError(const CLI::App& program, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    const CLI::App& command = chosen.empty() ? program : *chosen.front();
    const std::string line = program.get_name() + (chosen.empty() ? "" : " " + command.get_name());
    const std::string help = fmt::format("See {} --help.", line);
    for (const std::string& word : program.remaining(true)) {
        if (word.starts_with("--")) {
            const std::string name = word.substr(0, word.find('='));
            return fmt::format("`{}` has no option {}. {} {}", line, name,
                               base::suggestName(name, listOptionNames(command)), help);
        }
        if (chosen.empty() && !word.starts_with('-')) {
            const std::vector<std::string> names = listCommandNames(program);
            return fmt::format("There is no command \"{}\". {} The commands are {}. {}", word,
                               base::suggestName(word, names), fmt::join(names, ", "), help);
        }
    }
    if (chosen.empty() && program.remaining_size(true) == 0) {
        return fmt::format("Which command? There are {}. {}", fmt::join(listCommandNames(program), ", "),
                           help);
    }
    return fmt::format("{}. {}", error.what(), help);
}

}  // namespace trapwright::app
