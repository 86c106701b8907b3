#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/trapwright/command.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/track_source.h"
#include "core/store/study_file.h"
#include "core/study/evaluator.h"
#include "core/trial/goal.h"

namespace trapwright::app {

/// A track that is measured, and what with.
struct TrackSubject {
    study::StudyInputs inputs;
    std::shared_ptr<const track::Track> track;
    std::optional<trial::Goal> goal;       // of a track that tells it
    std::string name;                      // for people
    std::optional<store::StudyFile> file;  // the study that it is of
    study::IndividualId individual;        // of that
    nlohmann::ordered_json json;           // which track it is
};

/// How a command names one.
struct SubjectRequest {
    TrackRequest track;  // its file may be a study
    IndividualChoice choice;
    std::optional<std::string> engine;
    unsigned threads = 0;
    bool save = false;  // what comes of it, in the study
};

/// Adds FILE, those of addIndividualOptions() and addTrackOptions(), --save, --engine and --threads.
void addSubjectOptions(Command command, SubjectRequest& request);

/// Studies are databases; a track is JSON. What is not there is by its name what it was to be.
bool isTrackFile(const std::string& file);

/// The track of a file or of a study, by what the file is. Failures also: --save of a track that is of no
/// study.
Attempt<TrackSubject> loadSubject(const SubjectRequest& request, const Console& console);

}  // namespace trapwright::app
