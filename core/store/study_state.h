#pragma once

#include <initializer_list>
#include <memory>
#include <string>

#include "core/store/connection.h"
#include "core/store/file_lock.h"
#include "core/store/open_file.h"
#include "core/store/sqlite_forward.h"
#include "core/store/study_file.h"

namespace trapwright::store {

// Inside core/store only: SQLite's types end here.

/// What an open study holds. Closing gives the locks back after the database, never before.
struct StudyFile::State {
    std::filesystem::path path;
    std::string program;             // empty if read only
    std::shared_ptr<FileLock> lock;  // if open for writing; shared with those opened beside
    std::shared_ptr<OpenFile> file;  // likewise shared
    std::unique_ptr<SQLite::Database> database;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State();

    /// An error if the study was opened for reading only, or its file is not where it was.
    [[nodiscard]] base::Status checkWritable() const;
    [[nodiscard]] base::Status checkInPlace() const;
    /// What work() returns, or the error that its exception means. An error if the study cannot be written,
    /// or if its file was deleted or replaced before or meanwhile: nobody would find again what was saved.
    template <class Work>
    [[nodiscard]] base::Status save(const std::string& doing, const Work& work) const {
        if (auto writable = checkWritable(); !writable) return writable;
        auto saved = guarded(path, doing, work);
        if (auto writable = checkWritable(); !writable) return writable;
        return saved;
    }
    /// How many rows the table has; its rows are numbered from 0.
    [[nodiscard]] int countRows(const std::string& table) const;
};

/// Now, as ISO 8601.
std::string currentUtc();

/// A value from the file that cannot be; `what` names it.
base::Error damagedValue(const std::filesystem::path& path, const std::string& what);

/// Whether all of these can be counts out of `whole`: none negative, none more than there were.
bool areCounts(int whole, std::initializer_list<int> parts);

/// What trials belong to.
enum class OutcomeRun { generation, selection, validation };

/// Adds the trials of a run, within the caller's transaction; none are none. Throws SQLite::Exception.
void saveOutcomes(SQLite::Database& database, const std::string& program, OutcomeRun run, int number,
                  const trial::MadeOutcomes& made);

/// A rotation (w, x, y, z) from column `first` on.
base::Quaternion readRotation(const SQLite::Statement& statement, int first);
std::string readBlob(const SQLite::Statement& statement, int column);

}  // namespace trapwright::store
