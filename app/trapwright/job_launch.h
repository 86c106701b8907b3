#pragma once

#include <optional>
#include <string>

namespace trapwright::app {

/// How this process was started, as far as launchers of parallel jobs tell by their variables.
enum class JobLaunch {
    alone,    // by hand, or as a job of one
    mpi,      // by mpirun, or srun with MPI, as one of several
    separate  // by srun without MPI, as one of several that know nothing of each other
};

JobLaunch findJobLaunch();

/// What is wrong with JobLaunch::separate, and what to do.
std::string explainSeparateLaunch();

}  // namespace trapwright::app
