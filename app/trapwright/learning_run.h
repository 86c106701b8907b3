#pragma once

#include <cstdint>
#include <optional>

#include "app/trapwright/console.h"
#include "core/store/study_file.h"
#include "core/study/runner.h"

namespace trapwright::app {

/// How a learning run went.
struct LearningReport {
    study::LearningEnd end = study::LearningEnd::completed;
    bool interrupted = false;  // by Ctrl-C
    std::int64_t trials = 0;   // of this run
    double seconds = 0.0;      // of this run, without the checks after it
};

/// Learns from the last generation in the file on, saves each in it, prints a line for each and shows the
/// progress. Ctrl-C once ends it after the generation, twice at once. With a time limit [s] no generation is
/// begun that would probably end after it. If the engine setting has a reference, winners are checked
/// meanwhile and, when the last generation is there, those that are left; after an earlier end the next run
/// does that.
Attempt<LearningReport> runLearning(store::StudyFile& file, const study::StudyInputs& inputs,
                                    const Console& console, std::optional<double> timeLimit);

/// The heading of the lines that runLearning prints.
extern const char* const kLearningHeading;

}  // namespace trapwright::app
