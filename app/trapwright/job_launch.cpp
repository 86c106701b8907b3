#include "app/trapwright/job_launch.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

namespace trapwright::app {

namespace {

std::string_view environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

bool isSeveral(std::string_view count) {
    return !count.empty() && count != "1";
}

}  // namespace

JobLaunch findJobLaunch() {
    // Open MPI's mpirun; MPICH's and Intel's.
    for (const char* count : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
        if (isSeveral(environment(count))) return JobLaunch::mpi;
    // Set within a step of srun alone, not in a batch script.
    if (!isSeveral(environment("SLURM_STEP_NUM_TASKS"))) return JobLaunch::alone;
    const bool hasMpi = !environment("PMIX_RANK").empty() || !environment("PMI_RANK").empty();
    return hasMpi ? JobLaunch::mpi : JobLaunch::separate;
}

std::string explainSeparateLaunch() {
    return fmt::format(
        "srun started this as one of {} tasks that know nothing of each other: all would write the same "
        "study. "
        "Start it with mpirun within the job, or with srun --mpi=pmix (srun --mpi=list says what there is); "
        "for a "
        "single process take srun --ntasks 1.",
        environment("SLURM_STEP_NUM_TASKS"));
}

}  // namespace trapwright::app
