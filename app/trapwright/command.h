#pragma once

#include <functional>
#include <string>

#include "app/trapwright/console.h"
#include "app/trapwright/exit_codes.h"
#include "app/trapwright/options.h"

namespace trapwright::app {

/// Does a command's work. The value is the exit status where it ran to its end.
using CommandAction = std::function<Attempt<ExitCode>(const Console&)>;

/// What the command line asked for.
struct Invocation {
    CommandAction action;
    bool json = false;
};

/// Adds a command with --json and --help to the program. `example` is shown below the options. The caller
/// adds its options to the result, and its action is chosen when the command line names it.
Command addCommand(CLI::App& program, Invocation& invocation, const std::string& name,
                   const std::string& description, const std::string& example, CommandAction action);

// One per file, command_<name>.cpp.
void addPartCommand(CLI::App& program, Invocation& invocation);
void addMaterialsCommand(CLI::App& program, Invocation& invocation);
void addNewCommand(CLI::App& program, Invocation& invocation);
void addSettingsCommand(CLI::App& program, Invocation& invocation);
void addEvolveCommand(CLI::App& program, Invocation& invocation);
void addSelectCommand(CLI::App& program, Invocation& invocation);
void addValidateCommand(CLI::App& program, Invocation& invocation);
void addRobustnessCommand(CLI::App& program, Invocation& invocation);
void addStreamCommand(CLI::App& program, Invocation& invocation);
void addPhysicalCommand(CLI::App& program, Invocation& invocation);
void addMendCommand(CLI::App& program, Invocation& invocation);
void addExportCommand(CLI::App& program, Invocation& invocation);
void addReplayCommand(CLI::App& program, Invocation& invocation);
void addTrackCommand(CLI::App& program, Invocation& invocation);
void addSubmitCommand(CLI::App& program, Invocation& invocation);
void addSweepCommand(CLI::App& program, Invocation& invocation);
void addVerifyCommand(CLI::App& program, Invocation& invocation);
void addBenchCommand(CLI::App& program, Invocation& invocation);
void addDemoCommand(CLI::App& program, Invocation& invocation);
void addCompareCommand(CLI::App& program, Invocation& invocation);
void addDumpCommand(CLI::App& program, Invocation& invocation);
void addCompletionCommand(CLI::App& program, Invocation& invocation);

}  // namespace trapwright::app
