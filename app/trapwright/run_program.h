#pragma once

#include "app/trapwright/exit_codes.h"

namespace trapwright::app {

/// Does what the command line asks for, and says what is wrong. Once in a process.
ExitCode runProgram(int count, char** arguments);

}  // namespace trapwright::app
