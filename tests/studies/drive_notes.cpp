// Notes what the virtual feeder does in a study, as the studio's page Validate does: drive_notes STUDY ROUNDS
// Each round adds what the drive logged meanwhile, then a trial, and tells how many of both the study has
// from it. Ends with the exit codes of the command line: 3 the study cannot be used, 4 it cannot be written.
#include <QCoreApplication>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>

#include "app/transports/make_drive.h"
#include "app/transports/virtual_feeder.h"
#include "core/drive/drive_loop.h"
#include "core/drive/profile_folder.h"
#include "core/store/study_file.h"

using namespace trapwright;

namespace {

constexpr const char* kProfile = "virtual-reo";
constexpr auto kRound = std::chrono::milliseconds(30);

/// What the loop's thread has logged and nobody has saved yet.
class Unsaved {
 public:
    void add(const drive::LogEntry& entry) {
        const std::lock_guard lock(mutex_);
        entries_.push_back(entry);
    }
    std::vector<drive::LogEntry> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(entries_, {});
    }

 private:
    std::mutex mutex_;
    std::vector<drive::LogEntry> entries_;
};

int fail(int code, const std::string& message) {
    std::fprintf(stderr, "drive_notes: %s\n", message.c_str());
    return code;
}

int codeOf(const base::Error& error) {
    return error.kind == base::ErrorKind::cannotWrite ? 4 : 3;
}

std::optional<drive::Profile> findProfile() {
    const auto folder =
        drive::readProfileFolder(std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) / "resources/drives");
    for (const drive::Profile& profile : folder.profiles) {
        if (profile.name == kProfile) return profile;
    }
    return std::nullopt;
}

int noteRounds(store::StudyFile& study, int rounds, drive::DriveLoop& loop, Unsaved& unsaved) {
    study::PhysicalValidation validation;
    validation.plan = {{0}, rounds};
    validation.drive = kProfile;
    const auto before = study.loadPhysicalValidations();
    if (!before) return fail(codeOf(before.error()), before.error().message);
    const int number = static_cast<int>(before->size());
    if (const auto added = study.addPhysicalValidation(validation); !added)
        return fail(codeOf(added.error()), added.error().message);
    std::size_t lines = 0;
    for (int round = 0; round < rounds; ++round) {
        std::this_thread::sleep_for(kRound);
        if (loop.snapshot().state == drive::State::idle) loop.start();
        const std::vector<drive::LogEntry> entries = unsaved.take();
        if (const auto saved = study.appendDriveLog(entries); !saved)
            return fail(codeOf(saved.error()), saved.error().message);
        lines += entries.size();
        study::PhysicalTrial trial;
        trial.number = round;
        trial.feeder = study::FeederKind::virtualFeeder;
        if (const auto saved = study.addPhysicalTrial(number, trial); !saved)
            return fail(codeOf(saved.error()), saved.error().message);
        std::printf("saved: %zu lines, %d trials\n", lines, round + 1);
        (void)std::fflush(stdout);
    }
    return 0;
}

}  // namespace

int main(int count, char** arguments) {
    const QCoreApplication application(count, arguments);
    if (count != 3) return fail(2, "drive_notes STUDY ROUNDS");
    const auto profile = findProfile();
    if (!profile) return fail(2, "the drive's profile is missing.");
    auto feeder = transports::serveVirtualFeeder(*profile);
    if (!feeder) return fail(2, feeder.error().message);
    auto study = store::StudyFile::open(arguments[1], "drive_notes");
    if (!study) return fail(codeOf(study.error()), study.error().message);
    Unsaved unsaved;
    drive::DriveLoop loop(
        *profile, {0.9, 2.0}, [&] { return transports::makeDrive(*profile, (*feeder)->address()); },
        [&unsaved](const drive::LogEntry& entry) { unsaved.add(entry); });
    loop.setTarget(0.7);
    return noteRounds(*study, std::atoi(arguments[2]), loop, unsaved);  // NOLINT(cert-err34-c)
}
