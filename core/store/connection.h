#pragma once

#include <exception>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/store/open_file.h"
#include "core/store/sqlite_forward.h"

namespace trapwright::store {

// Inside core/store only: SQLite's types end here.

/// What a failure of SQLite means for the person who works with the study at `path`. `doing`: "The generation
/// could not be saved".
base::Error describeFailure(const std::exception& failure, const std::filesystem::path& path,
                            const std::string& doing);

/// Whether transactions are still waiting in the write-ahead log beside the study.
bool hasPendingLog(const std::filesystem::path& path);

/// An error if the file at `path` is plainly no study: empty, cut off, not SQLite.
base::Status checkStudyFile(const std::filesystem::path& path, const OpenFile& file);

/// An error if the study's log may lie beside another name of it, where SQLite does not look: it would make a
/// second one, and mix up the file.
base::Status checkOneLog(const std::filesystem::path& path, const OpenFile& file);

/// Opens an existing study for writing, in write-ahead mode so that readers are not disturbed, and brings its
/// schema up to date. On a network file system, where that would not be safe, with a rollback journal:
/// readers, also on other machines, wait while a generation is written. The caller holds the study's
/// FileLock, and its OpenFile locked.
base::Result<std::unique_ptr<SQLite::Database>> openForWriting(const std::filesystem::path& path);

/// The same once more for a study that openForWriting has open, which needs no checks.
base::Result<std::unique_ptr<SQLite::Database>> openBeside(const std::filesystem::path& path);

/// Whether the path that was opened still leads to this file: nobody has deleted, moved or replaced it.
bool isInPlace(SQLite::Database& database);

/// Opens an existing study for reading, while it is being written, and in folders that cannot be written; of
/// an older program a copy that is brought up to date, as it is now. The caller has its OpenFile.
base::Result<std::unique_ptr<SQLite::Database>> openForReading(const std::filesystem::path& path);

/// Moves everything into the one file, so that it can be copied and read from anywhere. Not possible while
/// somebody reads; then `-wal` and `-shm` stay beside the file and are taken up by the next writer.
void settle(SQLite::Database& database) noexcept;

/// What work() returns, or the error that its exception means.
template <class Work>
auto guarded(const std::filesystem::path& path, const std::string& doing, const Work& work)
    -> decltype(work()) {
    try {
        return work();
    } catch (const std::exception& failure) {
        return describeFailure(failure, path, doing);
    }
}

}  // namespace trapwright::store
