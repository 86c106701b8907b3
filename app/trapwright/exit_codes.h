#pragma once

#include <string>

#include "core/base/result.h"

namespace trapwright::app {

/// What the program's exit status means. The same for all commands; `trapwright --help` lists them.
enum class ExitCode : int {
    ok = 0,
    no = 1,             // it ran and the answer is no: verify failed, an exported file is not closed
    usage = 2,          // arguments or settings that cannot be used
    badInput = 3,       // a file that is missing, empty, damaged or cannot be used
    cannotWrite = 4,    // full disk, read-only folder, a study that was deleted or replaced meanwhile
    locked = 5,         // another process writes this study
    fault = 6,          // the engine or the program failed
    interrupted = 130,  // Ctrl-C; what was finished before is saved
};

/// The list above for people.
inline constexpr const char* kExitCodesText =
    "Exit codes: 0 all went well; 1 the answer is no (verify failed, an exported file is not closed); 2 "
    "arguments or\n"
    "settings that cannot be used; 3 a bad input file: missing, damaged, cannot be used; 4 cannot write: "
    "disk "
    "full, folder\n"
    "read-only, or the study's file was deleted or replaced meanwhile (then a copy, STUDY-rescued.trap, is "
    "written beside\n"
    "it); 5 another process writes the study; 6 the engine or the program failed; 130 interrupted by "
    "Ctrl-C.\n"
    "With --json a command prints one JSON document on stdout and nothing else; if it fails that is\n"
    "{\"error\": MESSAGE, \"exit_code\": N}, and the message goes to stderr as well.";

/// Why a command ends without having done its work.
struct Failure {
    ExitCode code = ExitCode::fault;
    std::string message;
};

/// A value, or why there is none and with which status the program ends.
template <class T>
using Attempt = base::Result<T, Failure>;

}  // namespace trapwright::app
