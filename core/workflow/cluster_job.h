#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/store/study_file.h"
#include "core/study/runner.h"
#include "core/workflow/learning.h"

/// Learning a study as a job of a batch system (Slurm): the job works on a copy in a folder of its own, and
/// what it learns comes home while it does.
namespace trapwright::workflow {

/// What a job is to have.
struct JobPlan {
    int ranks = 8;
    double hours = 24.0;                 // until it ends its time and queues itself again
    std::vector<std::string> options;    // more of sbatch's, as "--partition=long"
    std::string program = "trapwright";  // where the job runs
};

/// A job as it lies in its folder.
struct ClusterJob {
    std::filesystem::path folder;
    std::filesystem::path study;  // the copy that it learns
    std::string id;               // the batch system's; empty: not submitted
    bool isOver = false;          // and all that it learned was taken
};

/// Whether jobs can be submitted from here: there is an sbatch.
bool canSubmit();

/// Makes the folder: a copy of the study, the batch script, and submit.sh, which queues the job from wherever
/// the folder is copied to. Nothing is left behind on failure. An error if the folder exists, or the plan
/// cannot be.
base::Result<ClusterJob> writeJob(const store::StudyFile& study, const std::filesystem::path& folder,
                                  const JobPlan& plan);
/// A job that was written before. An error if the folder holds none.
base::Result<ClusterJob> readJob(const std::filesystem::path& folder);

/// Folders of a study's jobs are beside it: "pin-job", "pin-job-2". The newest one; empty: there is none.
std::filesystem::path findLastFolder(const std::filesystem::path& study);
/// Where the next one goes.
std::filesystem::path findNextFolder(const std::filesystem::path& study);

/// What a user types to queue it on another machine, where its folder was copied to.
std::string submitCommand(const ClusterJob& job);
/// Queues it, by its submit.sh, and keeps its id in the folder. The error has what sbatch said.
base::Status submitJob(ClusterJob& job);
/// Writes a job and queues it; if it cannot be queued nothing is left behind.
base::Result<ClusterJob> writeAndSubmit(const store::StudyFile& study, const std::filesystem::path& folder,
                                        const JobPlan& plan);

enum class JobState {
    waiting,  // in the queue, or between two
    running,
    over,    // ended, whether well or not
    unknown  // the batch system does not answer
};
/// What the batch system says of a job.
struct JobStatus {
    JobState state = JobState::waiting;
    std::string reason{};  // why it waits, in its words: "Resources", "Priority"; empty: not told

    friend bool operator==(const JobStatus&, const JobStatus&) = default;
};
JobStatus askJob(const ClusterJob& job, const base::RunControl& control = {});

enum class JobStop { afterGeneration, atOnce };
/// What the batch system says if it cannot.
base::Status stopJob(const ClusterJob& job, JobStop stop);
/// The end of what the job wrote, a few lines; empty: nothing yet.
std::string readLastWords(const ClusterJob& job);

/// How long it follows; from tests shorter.
struct FollowIntervals {
    std::chrono::milliseconds study{2000};  // between two looks at the job's study
    std::chrono::milliseconds state{5000};  // and at the queue
};

/// Takes what the job learns into the study, until it is over: events.saved and events.checked tell each,
/// `changed` each status. A job that was not submitted from here, but elsewhere or not at all, is taken as
/// far as it is. The control's stop and its cancel stop the job, after the generation or at once; `leave`
/// ends the watching, and the job goes on. Errors: the job's study is none of this one, cannot be read for a
/// minute, or cannot be saved.
Result<study::LearningEnd> followJob(store::StudyFile& file, const ClusterJob& job, const LearnEvents& events,
                                     const std::function<void(const JobStatus&)>& changed,
                                     const study::LearningControl& control,
                                     const base::RunControl& leave = {},
                                     const FollowIntervals& intervals = {});

}  // namespace trapwright::workflow
