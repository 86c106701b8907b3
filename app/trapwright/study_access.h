#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/trapwright/exit_codes.h"
#include "app/trapwright/options.h"
#include "core/store/study_file.h"
#include "core/study/evaluator.h"
#include "core/trial/engine_registry.h"

namespace trapwright::app {

enum class Access { read, write };

/// An open study with its settings and its part as it was built when the study was made.
struct OpenStudy {
    store::StudyFile file;
    study::Settings settings;
    std::shared_ptr<const part::Part> part;
};

Attempt<OpenStudy> openStudy(const std::string& path, Access access);

/// The same of a file that is open already.
Attempt<OpenStudy> loadStudy(store::StudyFile file);

/// An error of a study's file with the status that tells its kind; of one of no special kind with
/// `otherwise`.
Failure describeStudyFailure(const base::Error& error, ExitCode otherwise);
/// The same of a study that could not be made.
Failure describeCreateFailure(const std::string& path, const base::Error& error);

/// How a command names one individual of a study.
struct IndividualChoice {
    std::optional<int> generation;
    std::optional<int> individual;
};

/// Adds --generation and --individual.
void addIndividualOptions(Command command, IndividualChoice& choice);

/// The individual that is meant: the one named; a generation's winner; otherwise the final track that was
/// chosen in the studio, or the first of the last selection, or without any the best winner
/// (study::findBestWinner).
Attempt<study::Individual> findIndividual(const store::StudyFile& file, const IndividualChoice& choice);

/// The orientation of --expected: w x y z, or nothing. An error if they are all zero.
Attempt<std::optional<trial::Goal>> readExpected(const std::vector<double>& values);

/// Adds --conditions: what selection and validation are judged under.
void addConditionsOption(Command command, std::optional<std::string>& conditions);
/// Puts it into the settings, if it was given.
Attempt<ExitCode> takeConditions(const std::optional<std::string>& conditions, study::Settings& settings);

/// The engine for this use that the study's setting, or the one named, means; made for these threads (0:
/// all).
Attempt<study::StudyInputs> makeInputs(const OpenStudy& study, const std::optional<std::string>& engine,
                                       trial::EngineUse use, unsigned threads);

}  // namespace trapwright::app
