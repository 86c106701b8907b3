#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "app/trapwright/console.h"
#include "app/trapwright/job_launch.h"
#include "app/trapwright/run_program.h"
#include "core/base/child_process.h"

namespace {

using namespace trapwright;
using namespace trapwright::app;

/// Becomes the program that is linked with MPI, so that this one does not need it. Returns only if it cannot.
ExitCode becomeRank(char** arguments) {
    const Console console(false);
    const auto program = base::findOwnProgram("trapwright-mpi");
    if (!program)
        return console.fail({ExitCode::fault,
                             "This was started as a job of several ranks, for which the package "
                             "trapwright-mpi is needed. " +
                                 program.error().message});
    ::execv(program->c_str(), arguments);
    return console.fail({ExitCode::fault, program->string() + " cannot be started: " + std::strerror(errno)});
}

}  // namespace

int main(int argc, char** argv) {
    switch (findJobLaunch()) {
        case JobLaunch::mpi:
            return static_cast<int>(becomeRank(argv));
        case JobLaunch::separate:
            return static_cast<int>(Console(false).fail({ExitCode::usage, explainSeparateLaunch()}));
        case JobLaunch::alone:
            break;
    }
    return static_cast<int>(runProgram(argc, argv));
}
