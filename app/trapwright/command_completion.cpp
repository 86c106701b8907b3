#include <memory>
#include <nlohmann/json.hpp>

#include "app/trapwright/command.h"
#include "app/trapwright/completion.h"

namespace trapwright::app {

void addCompletionCommand(CLI::App& program, Invocation& invocation) {
    const auto shell = std::make_shared<std::string>();
    Command command =
        addCommand(program, invocation, "completion",
                   "Prints the script by which a shell completes commands, options and their values. The "
                   "packages install it.",
                   "source <(trapwright completion bash)", [shell, &program](const Console& console) {
                       const std::string script =
                           *shell == "bash" ? writeBashCompletion(program) : writeZshCompletion(program);
                       console.print(script);
                       console.emit({{"shell", *shell}, {"script", script}});
                       return ExitCode::ok;
                   });
    command.addOption("SHELL", *shell, "bash or zsh").required().oneOf({"bash", "zsh"});
    // Whoever needs it does so once; it is not among the commands of --help.
    command.hide();
}

}  // namespace trapwright::app
