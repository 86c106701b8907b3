#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/program.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/base/file.h"
#include "core/workflow/study_trials.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string study;
    IndividualChoice choice;
    std::string kind = "learning";
    int trial = 0;
    int pose = 1;           // as tables count
    double interval = 5.0;  // [ms]
    std::optional<std::string> out;
};

Failure refuseTrial(const Options& options, const study::Individual& individual, int trials) {
    if (trials == 0) {
        return {ExitCode::usage, fmt::format("Generation {}, individual {} has no {} trials to replay.",
                                             individual.generation, individual.individual, options.kind)};
    }
    return {ExitCode::usage,
            fmt::format("--trial {}: generation {}, individual {} has the {} trials 0 to {}.", options.trial,
                        individual.generation, individual.individual, options.kind, trials - 1)};
}

workflow::TrialsRequest makeRequest(const Options& options, study::Individual individual) {
    workflow::TrialsRequest request;
    if (options.kind == "selection") request.kind = workflow::TrialKind::selection;
    if (options.kind == "validation") request.kind = workflow::TrialKind::validation;
    request.winner = std::move(individual);
    request.poses = {options.pose - 1};
    return request;
}

void appendPose(std::string& text, const base::Pose& pose) {
    const base::Vec3 place = pose.position * 1e3;
    const base::Quaternion& q = pose.rotation;
    fmt::format_to(std::back_inserter(text), ",{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{:.9f}", place.x(),
                   place.y(), place.z(), q.w(), q.x(), q.y(), q.z());
}

std::string toCsv(const std::string& about, const trial::Trajectory& trajectory) {
    std::string text = about;
    text +=
        "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,room_x_mm,room_y_mm,room_z_mm,room_qw,room_qx,room_qy,room_qz,"
        "drive_x_mm,drive_y_mm,drive_z_mm,contacts\n";
    for (const trial::TrajectorySample& sample : trajectory.samples) {
        const trial::PartState& part = sample.parts.front();
        fmt::format_to(std::back_inserter(text), "{:.6f}", sample.time);
        appendPose(text, part.track);
        appendPose(text, part.room);
        const base::Vec3 drive = sample.drive * 1e3;
        fmt::format_to(std::back_inserter(text), ",{:.6f},{:.6f},{:.6f},{}\n", drive.x(), drive.y(),
                       drive.z(), part.contacts);
    }
    return text;
}

nlohmann::ordered_json sampleToJson(const trial::TrajectorySample& sample) {
    const trial::PartState& part = sample.parts.front();
    return {{"time_s", sample.time},
            {"position_mm", toJson(part.track.position, 1e3)},
            {"rotation", toJson(part.track.rotation)},
            {"room_position_mm", toJson(part.room.position, 1e3)},
            {"room_rotation", toJson(part.room.rotation)},
            {"drive_mm", toJson(sample.drive, 1e3)},
            {"contacts", part.contacts}};
}

using Difference = std::optional<workflow::OutcomeDifference>;

/// Where this replay of a trial ends otherwise than the study holds it.
base::Result<Difference> findDifference(const workflow::StoredTrials& stored, const trial::TrialBatch& batch,
                                        int trial, const trial::Engine& engine,
                                        const trial::Outcome& replayed) {
    const auto kept = workflow::unpackTrials(stored, batch);
    if (!kept) return kept.error();
    if (!*kept) return Difference();
    trial::OutcomeMaker maker = study::makerOf(engine);
    maker.program = kProgram;
    return workflow::findDifference((*kept)->outcomes[static_cast<std::size_t>(trial)], (*kept)->maker,
                                    replayed, maker);
}

nlohmann::ordered_json storedToJson(const Difference& difference) {
    if (!difference) return nullptr;
    const trial::PartOutcome& stored = difference->stored;
    return {{"ending", trial::endingName(stored.ending)},
            {"time_s", stored.time},
            {"farthest_x_mm", stored.farthest.position.x() * 1e3},
            {"program", difference->storedBy.program},
            {"engine", difference->storedBy.engine},
            {"instruction_set", difference->storedBy.instructionSet}};
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto study = openStudy(options.study, Access::read);
    if (!study) return study.error();
    auto individual = findIndividual(study->file, options.choice);
    if (!individual) return individual.error();
    const workflow::TrialsRequest request = makeRequest(options, *individual);
    const auto trials =
        workflow::findStoredTrials(study->file, study->settings, engines::registry(), request);
    if (!trials) return Failure{ExitCode::badInput, trials.error().message};
    if (options.trial < 0 || options.trial >= trials->count)
        return refuseTrial(options, *individual, trials->count);
    auto batch = workflow::makeTrials(study->settings, study->part, request, *trials);
    if (!batch) return Failure{ExitCode::badInput, batch.error().message};
    auto engine = makeEngine(trials->engine, {1, 0.0});
    if (!engine) return engine.error();

    base::RunControl control;
    auto trajectory = [&] {
        WorkWatch watch;
        watch.progress = [] { return std::string("Simulating the trial again"); };
        watch.interrupted = [control](int) mutable { control.cancel(); };
        const WorkDisplay display(console, watch);
        return (*engine)->replay(*batch, static_cast<std::size_t>(options.trial), options.interval * 1e-3,
                                 control);
    }();
    if (!trajectory) return describeRunFailure(control, trajectory.error());
    const auto difference = findDifference(*trials, *batch, options.trial, **engine, trajectory->outcome);
    if (!difference) return Failure{ExitCode::badInput, difference.error().message};
    if (*difference)
        console.note("This replay ends otherwise than the stored trial.\n" +
                     workflow::describe(**difference));

    const trial::PartOutcome& outcome = trajectory->outcome.parts.front();
    const std::string trialName =
        options.kind == "validation"
            ? fmt::format("validation trial {} of pose {}", options.trial, options.pose)
            : fmt::format("{} trial {}", options.kind, options.trial);
    const std::string about = fmt::format(
        "# {}: generation {}, individual {}, {}, part {}, engine {}\n"
        "# {} after {:.3f} s at x = {:.3f} mm; x along the track, y to its outer edge, z up; quaternions w, "
        "x, y, z\n",
        options.study, individual->generation, individual->individual, trialName, study->part->name,
        (*engine)->name(), trial::endingName(outcome.ending), outcome.time,
        outcome.farthest.position.x() * 1e3);
    if (options.out) {
        if (const auto written = base::writeFile(*options.out, toCsv(about, *trajectory)); !written)
            return Failure{ExitCode::cannotWrite, written.error().message};
        console.print(about +
                      fmt::format("Wrote {} poses to {}\n", trajectory->samples.size(), *options.out));
    } else {
        console.print(toCsv(about, *trajectory));
    }
    nlohmann::ordered_json samples = nlohmann::ordered_json::array();
    if (console.json() && !options.out)
        for (const trial::TrajectorySample& sample : trajectory->samples)
            samples.push_back(sampleToJson(sample));
    console.emit({{"study", options.study},
                  {"generation", individual->generation},
                  {"individual", individual->individual},
                  {"kind", options.kind},
                  {"trial", options.trial},
                  {"ending", trial::endingName(outcome.ending)},
                  {"time_s", outcome.time},
                  {"farthest_x_mm", outcome.farthest.position.x() * 1e3},
                  {"stored_otherwise", storedToJson(*difference)},
                  {"file", options.out ? nlohmann::ordered_json(*options.out) : nlohmann::ordered_json()},
                  {"samples", samples}});
    return ExitCode::ok;
}

}  // namespace

void addReplayCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "replay",
        "Simulates a stored trial again, bit for bit, and gives the part's poses over time as CSV.",
        "trapwright replay cuboid.trap --generation 12 --trial 3 --out trial.csv",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->study, "The study's file").required();
    addIndividualOptions(command, options->choice);
    command
        .addOption("--kind", options->kind,
                   "Which of its trials: learning, selection or validation (learning)")
        .oneOf({"learning", "selection", "validation"});
    command.addOption("--pose", options->pose, "Of a validation trial: the stable pose, from 1 (1)");
    command.addOption("--trial", options->trial, "The trial's number, from 0 (0)");
    command.addOption("--interval", options->interval, "Between two poses in ms (5)").range(0.01, 1e5);
    command.addOption("--out", options->out, "The file to write (default: standard output)");
}

}  // namespace trapwright::app
