#include "core/workflow/cluster_job.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <utility>

#include "core/base/command.h"
#include "core/base/file.h"
#include "core/base/resources.h"

namespace trapwright::workflow {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kScript = "trapwright.sbatch";
constexpr const char* kSubmit = "submit.sh";
constexpr const char* kNote = "job.json";
constexpr std::chrono::seconds kPatience{
    60};  // for the batch system's commands, and for a study that is busy

/// As one word of a shell.
std::string quoted(const std::string& text) {
    std::string word = "'";
    for (const char c : text)
        word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

/// "24:00:00"
std::string slurmTime(double hours) {
    constexpr double kMinutes = 60.0;
    const auto minutes = static_cast<long>(std::ceil(hours * kMinutes));
    return fmt::format("{}:{:02}:00", minutes / 60, minutes % 60);
}

std::string writeSubmit(const ClusterJob& job, const JobPlan& plan, int generations) {
    std::string options;
    for (const std::string& option : plan.options)
        options += " " + quoted(option);
    return fmt::format(
        "#!/bin/sh\n"
        "# Queues the job; prints its number. Made by Trapwright.\n"
        "cd \"$(dirname \"$0\")\" || exit 1\n"
        "TRAPWRIGHT=${{TRAPWRIGHT:-{}}} exec sbatch --parsable --ntasks={} --time={} --job-name={}{} {} {} "
        "--generations {}\n",
        quoted(plan.program), plan.ranks, slurmTime(plan.hours), quoted(job.study.stem().string()), options,
        kScript, quoted(job.study.filename().string()), generations);
}

base::Status writeNote(const ClusterJob& job) {
    const nlohmann::ordered_json note = {
        {"study", job.study.filename().string()}, {"job", job.id}, {"over", job.isOver}};
    return base::writeFile(job.folder / kNote, note.dump(2) + "\n");
}

base::Status fill(const store::StudyFile& study, const ClusterJob& job, const JobPlan& plan) {
    const auto settings = study.loadSettings();
    if (!settings) return settings.error();
    if (auto copied = study.copyTo(job.study); !copied) return copied;
    const auto script = base::readFile(base::findResource(std::string("slurm/") + kScript));
    if (!script) return script.error();
    if (auto written = base::writeFile(job.folder / kScript, *script); !written) return written;
    if (auto written =
            base::writeFile(job.folder / kSubmit, writeSubmit(job, plan, settings->evolution.generations));
        !written)
        return written;
    constexpr mode_t kForAll = 0755;
    for (const char* name : {kScript, kSubmit})
        if (::chmod((job.folder / name).c_str(), kForAll) != 0)
            return base::Error{"The job's scripts in " + job.folder.string() + " cannot be made executable.",
                               base::ErrorKind::cannotWrite};
    return writeNote(job);
}

/// Of an id: what goes on the command lines of others is nothing else.
bool hasOnlyDigits(const std::string& id) {
    return std::ranges::all_of(id, [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string trimmed(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
        text.pop_back();
    return text;
}

base::Result<base::CommandOutcome> ask(std::vector<std::string> arguments,
                                       const base::RunControl& control = {}) {
    return base::runCommand(std::move(arguments), "", kPatience, control);
}

std::filesystem::path folderName(const std::filesystem::path& study, int number) {
    std::filesystem::path folder = study;
    folder.replace_extension();
    folder += number == 1 ? "-job" : fmt::format("-job-{}", number);
    return folder;
}

/// Of the first folder that is not there.
int findFreeNumber(const std::filesystem::path& study) {
    std::error_code failure;
    int number = 1;
    while (std::filesystem::exists(folderName(study, number), failure))
        ++number;
    return number;
}

/// What is new in the job's study; none where nobody could look.
base::Result<std::optional<store::TakenGenerations>> look(store::StudyFile& file, const ClusterJob& job) {
    const auto away = store::StudyFile::openReadOnly(job.study);
    if (!away) {
        if (away.error().kind == base::ErrorKind::busy) return std::optional<store::TakenGenerations>();
        return away.error();
    }
    auto taken = file.takeGenerations(*away);
    if (!taken) {
        if (taken.error().kind == base::ErrorKind::busy) return std::optional<store::TakenGenerations>();
        return taken.error();
    }
    return std::optional(std::move(*taken));
}

}  // namespace

bool canSubmit() {
    return base::hasCommand("sbatch");
}

base::Result<ClusterJob> writeJob(const store::StudyFile& study, const std::filesystem::path& folder,
                                  const JobPlan& plan) {
    if (plan.ranks < 1) return base::Error{"A job needs one rank at least."};
    constexpr double kShortest = 0.05;  // [h]
    if (!(plan.hours >= kShortest)) return base::Error{"A job needs three minutes at least."};
    std::error_code failure;
    if (std::filesystem::exists(folder, failure))
        return base::Error{"There is a " + folder.string() +
                           " already. Go on with the job in it, remove it, or choose another folder."};
    if (!std::filesystem::create_directories(folder, failure))
        return base::Error{"The folder " + folder.string() + " cannot be made (" + failure.message() + ").",
                           base::ErrorKind::cannotWrite};
    const ClusterJob job{folder, folder / study.path().filename(), ""};
    if (const auto filled = fill(study, job, plan); !filled) {
        std::filesystem::remove_all(folder, failure);
        return filled.error();
    }
    return job;
}

base::Result<ClusterJob> readJob(const std::filesystem::path& folder) {
    const auto text = base::readFile(folder / kNote);
    if (!text)
        return base::Error{"There is no job of Trapwright in " + folder.string() + ": " +
                           text.error().message};
    const auto note = nlohmann::json::parse(*text, nullptr, false);
    const bool isNote = note.is_object() && note.contains("study") && note["study"].is_string() &&
                        note.contains("job") && note["job"].is_string() &&
                        (!note.contains("over") || note["over"].is_boolean());
    const std::string id = isNote ? note["job"].get<std::string>() : std::string();
    if (!isNote || !hasOnlyDigits(id))
        return base::Error{
            (folder / kNote).string() +
                " is damaged. Choose another folder for a new job; the study in this one may be whole.",
            base::ErrorKind::damaged};
    // A name, whatever the file says.
    const std::filesystem::path name = std::filesystem::path(note["study"].get<std::string>()).filename();
    return ClusterJob{folder, folder / name, id, note.value("over", false)};
}

std::filesystem::path findLastFolder(const std::filesystem::path& study) {
    const int free = findFreeNumber(study);
    return free == 1 ? std::filesystem::path() : folderName(study, free - 1);
}

std::filesystem::path findNextFolder(const std::filesystem::path& study) {
    return folderName(study, findFreeNumber(study));
}

base::Result<ClusterJob> writeAndSubmit(const store::StudyFile& study, const std::filesystem::path& folder,
                                        const JobPlan& plan) {
    auto job = writeJob(study, folder, plan);
    if (!job) return job;
    if (const auto queued = submitJob(*job); !queued) {
        std::error_code failure;
        std::filesystem::remove_all(folder, failure);
        return queued.error();
    }
    return job;
}

std::string submitCommand(const ClusterJob& job) {
    const std::string script = (job.folder.filename() / kSubmit).string();
    const bool isPlain = std::ranges::all_of(script, [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-' || c == '/';
    });
    return "sh " + (isPlain ? script : quoted(script));
}

base::Status submitJob(ClusterJob& job) {
    const auto queued = base::runCommand({(std::filesystem::absolute(job.folder) / kSubmit).string()},
                                         job.folder.string(), kPatience);
    if (!queued) return queued.error();
    // "123" or "123;cluster", after what a site's sbatch has to say.
    const std::string said = trimmed(queued->output);
    const std::string last = said.substr(said.find_last_of('\n') + 1);
    const std::string id = last.substr(0, last.find(';'));
    if (queued->code != 0 || id.empty() || !hasOnlyDigits(id))
        return base::Error{fmt::format("The job in {} could not be queued. sbatch said: {}",
                                       job.folder.string(),
                                       said.empty() ? fmt::format("nothing, code {}", queued->code) : said)};
    job.id = id;
    return writeNote(job);
}

JobStatus askJob(const ClusterJob& job, const base::RunControl& control) {
    const auto asked = ask({"squeue", "--noheader", "--format=%T %r", "--jobs=" + job.id}, control);
    if (!asked) return {JobState::unknown};
    const std::string said = trimmed(asked->output);
    if (asked->code != 0)
        // Of a job that ended some minutes ago it knows nothing any more.
        return {said.find("Invalid job id") != std::string::npos ? JobState::over : JobState::unknown};
    if (said.empty()) return {JobState::over};
    for (const char* state : {"RUNNING", "COMPLETING", "SUSPENDED", "STOPPED", "SIGNALING", "STAGE_OUT"})
        if (said.starts_with(state)) return {JobState::running};
    for (const char* state : {"PENDING", "CONFIGURING", "REQUEUED", "REQUEUE_HOLD", "REQUEUE_FED",
                              "RESV_DEL_HOLD", "SPECIAL_EXIT", "RESIZING"})
        if (said.starts_with(state)) {
            const std::string reason = said.substr(std::min(said.find(' '), said.size() - 1) + 1);
            return {JobState::waiting, reason == "None" ? std::string() : reason};
        }
    return {JobState::over};
}

base::Status stopJob(const ClusterJob& job, JobStop stop) {
    // Who waits has no generation that could end.
    const bool mayEnd = stop == JobStop::afterGeneration && askJob(job).state == JobState::running;
    const auto told =
        mayEnd ? ask({"scancel", "--batch", "--signal=USR2", job.id}) : ask({"scancel", job.id});
    if (!told) return told.error();
    if (told->code != 0)
        return base::Error{"Job " + job.id + " could not be stopped. scancel said: " + trimmed(told->output)};
    return base::success();
}

std::string readLastWords(const ClusterJob& job) {
    constexpr std::size_t kLines = 4;
    std::error_code failure;
    std::filesystem::path newest;
    std::filesystem::file_time_type written;
    for (const auto& entry : std::filesystem::directory_iterator(job.folder, failure)) {
        const auto time = entry.last_write_time(failure);
        if (failure || entry.path().extension() != ".out" || (!newest.empty() && time < written)) continue;
        newest = entry.path();
        written = time;
    }
    const auto text = newest.empty() ? base::Result<std::string>(std::string()) : base::readFile(newest);
    if (!text) return {};
    const std::string said = trimmed(*text);
    std::size_t from = said.size();
    for (std::size_t line = 0; line < kLines && from != std::string::npos && from > 0; ++line)
        from = said.rfind('\n', from - 1);
    return from == std::string::npos ? said : said.substr(from + 1);
}

Result<study::LearningEnd> followJob(store::StudyFile& file, const ClusterJob& job, const LearnEvents& events,
                                     const std::function<void(const JobStatus&)>& changed,
                                     const study::LearningControl& control, const base::RunControl& leave,
                                     const FollowIntervals& intervals) {
    constexpr std::chrono::milliseconds kNap{50};
    const bool isQueued = !job.id.empty();
    std::optional<JobStatus> status;
    if (!isQueued) status = {JobState::over};
    std::optional<JobStop> asked;
    Clock::time_point nextLook = Clock::now();
    Clock::time_point nextAsk = nextLook;
    Clock::time_point seen = nextLook;
    while (!leave.cancelled()) {
        const std::optional<JobStop> wanted = !isQueued                 ? std::nullopt
                                              : control.run.cancelled() ? std::optional(JobStop::atOnce)
                                              : control.stopRequested()
                                                  ? std::optional(JobStop::afterGeneration)
                                                  : std::nullopt;
        if (wanted && wanted != asked) {
            asked = wanted;
            if (const auto told = stopJob(job, *wanted); !told)
                return Failure{FailureKind::simulation, told.error().message};
            nextAsk = Clock::now();
        }
        if (isQueued && Clock::now() >= nextAsk) {
            const JobStatus now = askJob(job, leave);
            if (leave.cancelled()) break;
            if (now != status && changed) changed(now);
            status = now;
            nextAsk = Clock::now() + intervals.state;
        }
        const bool isOver = status && status->state == JobState::over;
        if (Clock::now() >= nextLook || isOver) {
            auto taken = look(file, job);
            if (!taken) return describeSaving(taken.error());
            if (*taken) {
                seen = Clock::now();
                for (const study::GenerationRecord& record : (*taken)->generations)
                    if (events.saved) events.saved(record);
                for (const study::CheckRecord& check : (*taken)->checks)
                    if (events.checked) events.checked(check);
                if (isOver) break;
            } else if (Clock::now() > seen + kPatience) {
                return Failure{FailureKind::reading,
                               "The job's study " + job.study.string() +
                                   " has been busy for a minute; is its disk connected?"};
            }
            nextLook = Clock::now() + intervals.study;
        }
        std::this_thread::sleep_for(kNap);
    }
    if (leave.cancelled()) return study::LearningEnd::cancelled;
    if (isQueued) {
        ClusterJob over = job;
        over.isOver = true;
        // Who cannot note it asks the batch system again.
        (void)writeNote(over);
    }
    if (control.run.cancelled()) return study::LearningEnd::cancelled;
    const auto settings = file.loadSettings();
    const auto count = file.generationCount();
    if (!settings || !count)
        return Failure{FailureKind::reading, settings ? count.error().message : settings.error().message};
    return *count >= settings->evolution.generations ? study::LearningEnd::completed
                                                     : study::LearningEnd::stopped;
}

}  // namespace trapwright::workflow
