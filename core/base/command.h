#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"

/// Other people's programs, as a user calls them.
namespace trapwright::base {

struct CommandOutcome {
    int code = 0;        // exit status; 128 + n: signal n ended it
    std::string output;  // what it wrote to stdout and stderr, as it came; at most 1 MiB
};

/// Whether there is a program of this name in PATH.
bool hasCommand(const std::string& name);

/// Starts a program, which is looked for in PATH unless its name has a slash, in this folder (empty: where we
/// are) and waits for its end. Error: it cannot be started, took longer or was cancelled; then it was killed.
Result<CommandOutcome> runCommand(std::vector<std::string> arguments, const std::string& folder,
                                  std::chrono::milliseconds limit, const RunControl& control = {});

}  // namespace trapwright::base
