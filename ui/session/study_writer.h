#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/store/study_file.h"
#include "core/study/settings.h"

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

}  // namespace trapwright::session
