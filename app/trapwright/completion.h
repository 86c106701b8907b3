#pragma once

#include <CLI/App.hpp>

#include <string>

namespace trapwright::app {

/// A completion script for bash (with the package bash-completion) made from the program's commands, their
/// options and what those take.
std::string writeBashCompletion(const CLI::App& program);

/// The same for zsh, as a function to be loaded by its completion system.
std::string writeZshCompletion(const CLI::App& program);

}  // namespace trapwright::app
