#include "app/trapwright/run_program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <string>
#include <string_view>

#include "app/trapwright/command_line.h"
#include "app/trapwright/engines.h"

namespace trapwright::app {

namespace {

/// Where the command line itself is wrong, --json has to be found by hand.
bool asksForJson(int count, char** arguments) {
    return std::any_of(arguments, arguments + count,
                       [](const char* argument) { return std::string_view(argument) == "--json"; });
}

Attempt<ExitCode> perform(const CommandAction& action, const Console& console) {
    try {
        if (auto obeyed = obeyEnvironment(); !obeyed) return obeyed;
        return action(console);
    } catch (const std::exception& exception) {
        return Failure{ExitCode::fault, std::string("A fault of the program or of a library that it uses: ") +
                                            exception.what() + ". Please report it with the command."};
    }
}

}  // namespace

ExitCode runProgram(int count, char** arguments) {
    // A file that reaches its size limit is an error to report like a full disk, not the end of the process.
    (void)std::signal(SIGXFSZ, SIG_IGN);
    CLI::App program("Designs tracks for vibratory part feeders.", "trapwright");
    Invocation invocation;
    buildCommandLine(program, invocation);
    try {
        program.parse(count, arguments);
    } catch (const CLI::Success& helpOrVersion) {
        return static_cast<ExitCode>(program.exit(helpOrVersion));
    } catch (const CLI::ParseError& error) {
        return Console(asksForJson(count, arguments))
            .fail({ExitCode::usage, explainParseError(program, error)});
    }

    const Console console(invocation.json);
    Attempt<ExitCode> result = perform(invocation.action, console);
    const ExitCode code = result ? *result : console.fail(result.error());
    if (console.flush()) return code;
    console.note("Not everything could be printed: standard output cannot be written (is the disk full?).");
    return ExitCode::cannotWrite;
}

}  // namespace trapwright::app
