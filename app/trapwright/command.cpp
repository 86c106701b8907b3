#include "app/trapwright/command.h"

#include <CLI/App.hpp>
#include <utility>

namespace trapwright::app {

Command addCommand(CLI::App& program, Invocation& invocation, const std::string& name,
                   const std::string& description, const std::string& example, CommandAction action) {
    CLI::App& command = *program.add_subcommand(name, description);
    command.group("Commands");
    command.footer("Example:\n  " + example);
    command.add_flag("--json", invocation.json, "Print one JSON document for machines and nothing else");
    command.callback([&invocation, action = std::move(action)] { invocation.action = action; });
    return Command(command);
}

}  // namespace trapwright::app
