#pragma once

#include <CLI/App.hpp>

#include <string>

#include "app/trapwright/command.h"

namespace trapwright::app {

/// Makes the program's command line: all commands, their help as HelpFormatter writes it, --version.
void buildCommandLine(CLI::App& program, Invocation& invocation);

/// What is wrong with a command line that could not be read, and what to do: an unknown command or option is
/// named with the nearest that there is.
std::string explainParseError(const CLI::App& program, const CLI::ParseError& error);

}  // namespace trapwright::app
