#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/trapwright/command.h"
#include "app/trapwright/learning_run.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/study_options.h"
#include "core/workflow/cluster_job.h"

namespace trapwright::app {

namespace {

using workflow::ClusterJob;

struct Options {
    std::string study;
    SettingOptions settings;
    workflow::JobPlan plan;
    std::optional<std::string> folder;
    bool isLeft = false;  // when it is queued
};

/// The job that a folder holds; none if there is no such folder.
Attempt<std::optional<ClusterJob>> findJob(const std::filesystem::path& folder) {
    std::error_code failure;
    if (!std::filesystem::exists(folder, failure)) return std::optional<ClusterJob>();
    auto job = workflow::readJob(folder);
    if (!job) return Failure{ExitCode::badInput, job.error().message};
    return std::optional(std::move(*job));
}

/// Where the study's newest job is or, if that is over or there is none, where the next one goes.
std::filesystem::path chooseFolder(const std::filesystem::path& study) {
    std::filesystem::path last = workflow::findLastFolder(study);
    if (last.empty()) return workflow::findNextFolder(study);
    const auto job = workflow::readJob(last);
    const bool goesOn =
        !job || job->id.empty() || (!job->isOver && workflow::askJob(*job).state != workflow::JobState::over);
    return goesOn ? last : workflow::findNextFolder(study);
}

/// What the job's study has and this one has not.
Attempt<int> take(OpenStudy& study, const ClusterJob& job) {
    const auto away = store::StudyFile::openReadOnly(job.study);
    if (!away) return Failure{ExitCode::badInput, away.error().message};
    const auto taken = study.file.takeGenerations(*away);
    if (!taken) return describeStudyFailure(taken.error(), ExitCode::badInput);
    return static_cast<int>(taken->generations.size());
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto study = openStudy(options.study, Access::write);
    if (!study) return study.error();
    if (auto changed = changeSettings(*study, options.settings); !changed) return changed.error();
    const std::filesystem::path folder =
        options.folder ? std::filesystem::path(*options.folder) : chooseFolder(study->file.path());
    auto found = findJob(folder);
    if (!found) return found.error();
    nlohmann::ordered_json document = {{"study", options.study}, {"folder", folder.string()}};
    ClusterJob job;
    if (*found) {
        job = **found;
        const auto taken = take(*study, job);
        if (!taken) return taken.error();
        console.print(fmt::format("{} new generations from {}.\n", *taken, folder.string()));
        document["taken"] = *taken;
    } else {
        const bool isQueuedHere = workflow::canSubmit();
        auto written = isQueuedHere ? workflow::writeAndSubmit(study->file, folder, options.plan)
                                    : workflow::writeJob(study->file, folder, options.plan);
        if (!written)
            return describeStudyFailure(written.error(), isQueuedHere ? ExitCode::fault : ExitCode::usage);
        job = std::move(*written);
        if (isQueuedHere)
            console.print(
                fmt::format("Job {} of {} ranks in {}.\n", job.id, options.plan.ranks, folder.string()));
    }
    const auto end = [&](ExitCode code) {
        document["job"] = job.id.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(job.id);
        const auto count = study->file.generationCount();
        if (count) document["generations"] = *count;
        console.emit(document);
        return code;
    };
    if (job.id.empty() && !workflow::canSubmit()) {
        console.print(
            fmt::format("The job is written: {}. There is no sbatch here: copy the folder to the cluster, "
                        "and queue it there: {}\nThen bring what it learned home, at any time: trapwright "
                        "submit {} --folder {}\n",
                        folder.string(), workflow::submitCommand(job), options.study, folder.string()));
        return end(ExitCode::ok);
    }
    if (job.id.empty()) {
        if (const auto queued = workflow::submitJob(job); !queued)
            return Failure{ExitCode::fault, queued.error().message};
        console.print(fmt::format("Job {} in {}.\n", job.id, folder.string()));
    }
    if (options.isLeft) return end(ExitCode::ok);
    console.print(learningHeading(study->settings.evolution));
    const auto followed = followLearning(study->file, study->settings, job, console);
    if (!followed) return followed.error();
    const bool isDone = *followed == study::LearningEnd::completed;
    if (!isDone)
        console.note(
            fmt::format("The job is over before its last generation. What it said last, in {}:\n{}\n"
                        "Go on with: trapwright submit {}",
                        folder.string(), workflow::readLastWords(job), options.study));
    return end(isDone ? ExitCode::ok : ExitCode::interrupted);
}

}  // namespace

void addSubmitCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "submit",
        "Learns a study as a job of Slurm: writes a folder with a copy of it and a batch script, queues "
        "that,\n"
        "and takes home what it learns while it does. Again, it follows the job that goes on. Ctrl-C once "
        "stops\n"
        "stops the job after the generation, twice at once. Without sbatch the folder is for another\n"
        "machine.",
        "trapwright submit pin.trap --ranks 64 --generations 200\n"
        "  trapwright submit pin.trap --ranks 64 --sbatch=--partition=long",
        [options](const Console& console) { return run(*options, console); });
    constexpr int kMostRanks = 100000;
    constexpr double kShortest = 0.05;    // [h]
    constexpr double kLongest = 10000.0;  // [h]
    command.addOption("STUDY", options->study, "The study's file").required();
    command.addOption("--ranks", options->plan.ranks, "Processes of the job (8)").range(1, kMostRanks);
    command.addOption("--hours", options->plan.hours, "Of one turn; then it queues itself again (24)")
        .range(kShortest, kLongest);
    command.addOption("--sbatch", options->plan.options, "Another option for sbatch; as often as you like")
        .type("OPTION")
        .repeatable();
    command.addOption("--program", options->plan.program, "Trapwright, where the job runs (trapwright)")
        .type("FILE");
    command.addOption("--folder", options->folder, "The job's folder (STUDY-job beside the study)")
        .type("DIR");
    command.addFlag("--no-follow", options->isLeft, "End when the job is queued");
    addSettingOptions(command, options->settings);
}

}  // namespace trapwright::app
