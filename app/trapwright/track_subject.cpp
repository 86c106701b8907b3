#include "app/trapwright/track_subject.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "app/trapwright/engines.h"
#include "app/trapwright/study_jobs.h"
#include "core/study/track_design.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

using Json = nlohmann::ordered_json;

Attempt<TrackSubject> loadOfFile(const SubjectRequest& request, const Console& console) {
    auto loaded = loadTrack(request.track, console);
    if (!loaded) return loaded.error();
    auto engine =
        makeJudge(request.engine.value_or(engines::registry().reference().name), {request.threads, 0.0});
    if (!engine) return engine.error();
    const std::string name =
        fmt::format("{}, part {}, engine {}", request.track.file, loaded->part->name, (*engine)->name());
    Json json = {{"track", request.track.file}, {"part", loaded->part->name}};
    return TrackSubject{{loaded->settings, loaded->part, *engine, request.threads},
                        loaded->track,
                        loaded->expected ? std::optional(trial::makeGoal(*loaded->expected)) : std::nullopt,
                        name,
                        std::nullopt,
                        {},
                        std::move(json)};
}

Attempt<TrackSubject> loadOfStudy(const SubjectRequest& request) {
    auto study = openStudy(request.track.file, request.save ? Access::write : Access::read);
    if (!study) return study.error();
    auto individual = findIndividual(study->file, request.choice);
    if (!individual) return individual.error();
    auto inputs = makeInputs(*study, request.engine, trial::EngineUse::learning, request.threads);
    if (!inputs) return inputs.error();
    auto built = study::decodeTrack(inputs->settings.track, individual->record.design);
    if (!built) return Failure{ExitCode::badInput, built.error().message};
    const std::string name = fmt::format("Generation {}, individual {}, engine {}", individual->generation,
                                         individual->individual, inputs->engine->name());
    Json json = {{"study", request.track.file},
                 {"generation", individual->generation},
                 {"individual", individual->individual}};
    return TrackSubject{
        std::move(*inputs),     std::make_shared<const track::Track>(std::move(*built)), std::nullopt,   name,
        std::move(study->file), {individual->generation, individual->individual},        std::move(json)};
}

}  // namespace

void addSubjectOptions(Command command, SubjectRequest& request) {
    command.addOption("FILE", request.track.file, "A study, or a track as JSON in mm").required();
    addIndividualOptions(command, request.choice);
    addTrackOptions(command, request.track);
    command.addFlag("--save", request.save,
                    "Keep it in the study, for the Review page; replaces what it held");
    command.addOption("--engine", request.engine, "What simulates (default: what the study learns with)");
    command.addOption("--threads", request.threads, "Threads (default: all processors)");
}

bool isTrackFile(const std::string& file) {
    std::ifstream stream(file);
    if (!stream) return std::filesystem::path(file).extension() == ".json";
    stream >> std::ws;
    return stream.peek() == '{';
}

Attempt<TrackSubject> loadSubject(const SubjectRequest& request, const Console& console) {
    if (!isTrackFile(request.track.file)) return loadOfStudy(request);
    if (request.save)
        return Failure{ExitCode::usage,
                       fmt::format("--save needs a study, and {} is a track; --json prints what comes of it "
                                   "for a file of your own.",
                                   request.track.file)};
    return loadOfFile(request, console);
}

}  // namespace trapwright::app
