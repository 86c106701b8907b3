#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/base/result.h"
#include "core/store/study_file.h"
#include "core/study/settings.h"
#include "ui/session/work_thread.h"

namespace trapwright::session {

/// The study file as the one thread has it that writes it. Used by that thread, but for setPending().
class StudyWriter {
 public:
    explicit StudyWriter(store::StudyFile file) : file_(std::move(file)) {}

    /// Has these settings, and the part if one is given, saved by the next savePending().
    void setPending(const study::Settings& settings, const std::shared_ptr<const store::StoredPart>& part);
    /// Saves the newest settings that are not saved yet. What cannot be saved stays pending.
    base::Status savePending();
    [[nodiscard]] store::StudyFile& file() { return file_; }
    /// Copies the study and goes on with the copy.
    base::Status moveTo(const std::filesystem::path& path, const std::string& program);

 private:
    store::StudyFile file_;
    std::mutex mutex_;
    std::optional<study::Settings> settings_;        // pending
    std::shared_ptr<const store::StoredPart> part_;  // likewise; null: not changed
};

/// What is noted beside the work on a study (trials on the feeder, the drive's log, choices), written by a
/// thread of its own, one note after the other, so that nothing waits for a generation. A note that cannot be
/// written is kept with those that follow, and tried again with the next one and in the end.
class StudyLedger {
 public:
    using Note = std::function<base::Status(store::StudyFile&)>;

    /// `file` was opened beside the one that the study's work is saved in; without one nothing can be
    /// written. `failed` is told on the ledger's thread, once until notes are written again.
    StudyLedger(std::optional<store::StudyFile> file, std::function<void(const std::string& message)> failed);
    StudyLedger(const StudyLedger&) = delete;
    StudyLedger& operator=(const StudyLedger&) = delete;
    /// Writes what is left.
    ~StudyLedger();

    void add(Note note);
    /// Waits until all is written; the error of the first note that cannot be.
    base::Status finish();
    /// Writes into this file from now on, also what could not be written so far.
    void moveTo(std::optional<store::StudyFile> file);

 private:
    base::Status write();

    std::optional<store::StudyFile> file_;
    std::function<void(const std::string&)> failed_;
    std::deque<Note> left_;  // on the thread
    bool failing_ = false;   // likewise
    std::unique_ptr<WorkThread> thread_;
};

}  // namespace trapwright::session
