#pragma once

#include <optional>

#include "app/trapwright/console.h"
#include "core/store/study_file.h"
#include "core/workflow/cluster_job.h"
#include "core/workflow/learning.h"

namespace trapwright::app {

/// How a learning run on a terminal went.
struct LearningRun {
    workflow::LearningReport report;
    bool interrupted = false;  // by Ctrl-C
};

/// Learns from the last generation in the file on, saves each in it, prints a line for each and shows the
/// progress. Ctrl-C once ends it after the generation, twice at once. With a time limit [s] no generation is
/// begun that would probably end after it. If the engine setting has a reference, winners are checked
/// meanwhile and, when the last generation is there, those that are left; after an earlier end the next run
/// does that.
Attempt<LearningRun> runLearning(store::StudyFile& file, const study::StudyInputs& inputs,
                                 const Console& console, std::optional<double> timeLimit);

/// The same of a job that learns the study elsewhere (workflow::followJob): what it learns is saved in the
/// file as it comes. Ctrl-C once stops the job after the generation, twice at once.
Attempt<study::LearningEnd> followLearning(store::StudyFile& file, const study::Settings& settings,
                                           const workflow::ClusterJob& job, const Console& console);

/// The heading of the lines that runLearning prints.
std::string learningHeading(const study::EvolutionSettings& settings);

}  // namespace trapwright::app
