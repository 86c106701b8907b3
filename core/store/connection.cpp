#include "core/store/connection.h"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <sqlite3.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "core/store/schema.h"

namespace trapwright::store {

namespace {

constexpr int kBusyTimeout = 5000;  // [ms]
constexpr std::size_t kHeaderSize = 100;
constexpr std::string_view kMagic("SQLite format 3\0", 16);

using DatabasePtr = std::unique_ptr<SQLite::Database>;

base::Error damaged(const std::filesystem::path& path, const std::string& how) {
    return base::Error{"The study " + path.string() + " is damaged: " + how + ". Restore it from a copy.",
                       base::ErrorKind::damaged};
}

/// Where SQLite keeps what belongs to the study: beside the file itself, not beside a link to it.
std::filesystem::path sidePath(const std::filesystem::path& path, const char* suffix) {
    std::error_code unknown;
    std::filesystem::path side = std::filesystem::weakly_canonical(path, unknown);
    if (unknown) side = path;
    side += suffix;
    return side;
}

std::uint64_t bigEndian(const std::string& header, std::size_t offset, std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
        value = (value << 8U) | static_cast<unsigned char>(header[offset + i]);
    return value;
}

/// "file:" with everything escaped that means something in a URI.
std::string immutableUri(const std::filesystem::path& path) {
    constexpr std::string_view kHex = "0123456789ABCDEF";
    std::string uri = "file:";
    for (const char c : std::filesystem::absolute(path).string()) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '-' || c == '_') {
            uri += c;
        } else {
            uri += '%';
            uri += kHex[byte >> 4U];
            uri += kHex[byte & 15U];
        }
    }
    return uri + "?immutable=1";
}

/// For SQLite, which takes ":memory:" and "file:" for something else.
std::string fileName(const std::filesystem::path& path) {
    return std::filesystem::absolute(path).string();
}

/// A study may come from anywhere: what its schema says is not run, nor can it be made to damage itself.
void distrust(SQLite::Database& database) {
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
}

/// Ours, and of a version that we know? Reads the file, so that an unreadable one fails here.
base::Status checkIdentity(SQLite::Database& database, const std::filesystem::path& path) {
    if (database.execAndGet("PRAGMA application_id").getInt() != kApplicationId) {
        return base::Error{path.string() +
                           " is a SQLite file, but not a study of Trapwright. Choose a .trap file."};
    }
    const int version = database.execAndGet("PRAGMA user_version").getInt();
    if (version > currentSchemaVersion()) {
        return base::Error{"The study " + path.string() +
                           " was written by a newer Trapwright (schema version " + std::to_string(version) +
                           "; this one knows up to " + std::to_string(currentSchemaVersion()) +
                           "). Update Trapwright to open it."};
    }
    return base::success();
}

base::Status checkContent(SQLite::Database& database, const std::filesystem::path& path) {
    if (database.execAndGet("SELECT count(*) FROM study").getInt() == 1) return base::success();
    return damaged(path, "it holds no settings");
}

base::Status checkPages(SQLite::Database& database, const std::filesystem::path& path) {
    const std::string check = database.execAndGet("PRAGMA quick_check(1)").getString();
    if (check == "ok") return base::success();
    return damaged(path, check.substr(check.rfind('\n') + 1));
}

/// Of an older program's study, in a temporary file of SQLite's own that goes with the connection: the study
/// stays as it is.
base::Result<DatabasePtr> copyUpToDate(SQLite::Database& old, const std::filesystem::path& path) {
    auto copy = std::make_unique<SQLite::Database>("", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    if (const int code = SQLite::Backup(*copy, old).executeStep(); code != SQLITE_DONE)
        throw SQLite::Exception("it could not be copied", code);
    distrust(*copy);
    if (const auto whole = checkPages(*copy, path); !whole) return whole.error();
    migrate(*copy, schemaMigrations());
    copy->exec("PRAGMA query_only = 1");
    return copy;
}

base::Result<DatabasePtr> openReader(const std::filesystem::path& path, bool immutable) {
    auto database = std::make_unique<SQLite::Database>(
        immutable ? immutableUri(path) : fileName(path),
        SQLite::OPEN_READONLY | (immutable ? SQLite::OPEN_URI : 0), kBusyTimeout);
    distrust(*database);
    if (const auto known = checkIdentity(*database, path); !known) return known.error();
    if (database->execAndGet("PRAGMA user_version").getInt() < currentSchemaVersion()) {
        try {
            auto copy = copyUpToDate(*database, path);
            if (!copy) return copy.error();
            database = std::move(copy).value();
        } catch (const SQLite::Exception& failure) {
            if (failure.getErrorCode() != SQLITE_FULL) throw;
            return base::Error{
                "The study " + path.string() +
                    " was written by an older Trapwright and is read from a temporary copy, for "
                    "which there is no room. Free some space where temporary files are, or name "
                    "another folder for them in TMPDIR.",
                base::ErrorKind::cannotWrite};
        }
    }
    if (const auto content = checkContent(*database, path); !content) return content.error();
    return database;
}

/// Whether other machines may see this file, too: a write-ahead log has its index in memory that they do not
/// share (https://www.sqlite.org/wal.html). Unknown file systems count as local ones.
bool isOnNetwork(const std::filesystem::path& path) {
    // For file systems that are not known here, and for tests.
    if (const char* said = std::getenv("TRAPWRIGHT_NETWORK_DISK")) return std::string_view(said) == "1";
    // As statfs(2) and linux/magic.h have them: NFS, SMB, CIFS, SMB2, Lustre, GPFS, Ceph, BeeGFS, AFS, Coda,
    // FUSE (sshfs, GlusterFS).
    constexpr std::array<std::uint32_t, 11> kNetworks = {0x6969,     0x517b,     0xff534d42, 0xfe534d42,
                                                         0x0bd00bd0, 0x47504653, 0x00c36400, 0x19830326,
                                                         0x5346414f, 0x73757245, 0x65735546};
    struct statfs status {};
    return ::statfs(path.c_str(), &status) == 0 &&
           std::ranges::find(kNetworks, static_cast<std::uint32_t>(status.f_type)) != kNetworks.end();
}

}  // namespace

base::Error describeFailure(const std::exception& failure, const std::filesystem::path& path,
                            const std::string& doing) {
    using Kind = base::ErrorKind;
    const std::string study = path.string();
    const auto* sqlite = dynamic_cast<const SQLite::Exception*>(&failure);
    switch (sqlite != nullptr ? sqlite->getErrorCode() : SQLITE_ERROR) {
        case SQLITE_FULL:
            return {doing + ": the disk that holds " + study +
                        " is full. Free some space and start again; what was saved before is safe.",
                    Kind::cannotWrite};
        case SQLITE_IOERR:
            return {doing + ": the disk that holds " + study + " could not be read or written (" +
                        failure.what() +
                        "). Check that it has space and is still connected; what was saved before is safe.",
                    Kind::cannotWrite};
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
            return {doing + ": " + damaged(path, failure.what()).message, Kind::damaged};
        case SQLITE_READONLY:
        case SQLITE_CANTOPEN:
        case SQLITE_PERM:
        case SQLITE_AUTH:
            return {doing + ": " + study + " or its folder cannot be written or read (" + failure.what() +
                        "). Check the permissions, or copy the study into a folder of your own.",
                    Kind::cannotWrite};
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return {doing + ": " + study + " is in use by another program (" + failure.what() +
                        "). Close that and try again.",
                    Kind::busy};
        default:
            return {doing + ": " + study + ": " + failure.what() +
                    ". If that happens again, restore it from a copy."};
    }
}

bool hasPendingLog(const std::filesystem::path& path) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(sidePath(path, "-wal"), missing);
    return !missing && size > 0;
}

base::Status checkStudyFile(const std::filesystem::path& path, const OpenFile& file) {
    const std::string header = file.readBeginning(kHeaderSize);
    if (header.empty())
        return base::Error{path.string() + " is empty, so it is not a study. Choose another file."};
    if (header.substr(0, kMagic.size()) != kMagic.substr(0, header.size()))
        return base::Error{path.string() + " is not a study of Trapwright. Choose a .trap file."};
    if (header.size() < kHeaderSize)
        return damaged(path, "it is cut off after " + std::to_string(header.size()) + " bytes");

    // While a log is pending the file may rightly be shorter than it will be.
    if (hasPendingLog(path)) return base::success();
    const std::uint64_t storedPageSize = bigEndian(header, 16, 2);
    const std::uint64_t pageSize = storedPageSize == 1 ? 65536 : storedPageSize;
    const std::uint64_t expected = pageSize * bigEndian(header, 28, 4);
    const auto size = file.size();
    // The log may have been taken in since: what counts is a file too short both before and after that.
    if (size < expected && !hasPendingLog(path)) {
        return damaged(path, "it is cut off after " + std::to_string(size) + " of " +
                                 std::to_string(expected) + " bytes");
    }
    return base::success();
}

base::Status checkOneLog(const std::filesystem::path& path, const OpenFile& file) {
    constexpr std::size_t kReadVersion = 19;
    constexpr char kWithLog = 2;
    std::error_code missing;
    const std::string header = file.readBeginning(kHeaderSize);
    if (file.countNames() < 2 || header.size() < kHeaderSize || header[kReadVersion] != kWithLog ||
        std::filesystem::exists(sidePath(path, "-wal"), missing))
        return base::success();
    return base::Error{"The study " + path.string() +
                       " has another name (a hard link), beside which the log with its last generations may "
                       "lie. Open it by that name, or copy it and open the copy."};
}

base::Result<DatabasePtr> openForWriting(const std::filesystem::path& path) {
    if (::access(path.c_str(), W_OK) != 0) {
        return base::Error{"The study " + path.string() + " cannot be written (" +
                               std::generic_category().message(errno) +
                               "). Change its permissions, or copy it into a folder that you can write.",
                           base::ErrorKind::cannotWrite};
    }
    return guarded(path, "The study could not be opened", [&]() -> base::Result<DatabasePtr> {
        auto database =
            std::make_unique<SQLite::Database>(fileName(path), SQLite::OPEN_READWRITE, kBusyTimeout);
        distrust(*database);
        if (const auto known = checkIdentity(*database, path); !known) return known.error();
        if (const auto whole = checkPages(*database, path); !whole) return whole.error();
        migrate(*database, schemaMigrations());
        if (const auto content = checkContent(*database, path); !content) return content.error();
        // Not every file system can do this; then readers wait while a generation is written.
        database->execAndGet(isOnNetwork(path) ? "PRAGMA journal_mode = DELETE"
                                               : "PRAGMA journal_mode = WAL");
        database->exec("PRAGMA synchronous = FULL");
        // Whoever reads first makes the log; what keeps it from that is to be told here.
        database->execAndGet("SELECT count(*) FROM study");
        return database;
    });
}

base::Result<DatabasePtr> openBeside(const std::filesystem::path& path) {
    return guarded(path, "The study could not be opened", [&]() -> base::Result<DatabasePtr> {
        auto database =
            std::make_unique<SQLite::Database>(fileName(path), SQLite::OPEN_READWRITE, kBusyTimeout);
        distrust(*database);
        database->exec("PRAGMA synchronous = FULL");
        return database;
    });
}

bool isInPlace(SQLite::Database& database) {
    int moved = 0;
    const int answer = sqlite3_file_control(database.getHandle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
    return answer != SQLITE_OK || moved == 0;
}

base::Result<DatabasePtr> openForReading(const std::filesystem::path& path) {
    const std::string doing = "The study could not be opened";
    return guarded(path, doing, [&]() -> base::Result<DatabasePtr> {
        try {
            return openReader(path, false);
        } catch (const SQLite::Exception& failure) {
            // A study that was not settled (a reader was there when its writer ended), in a folder where
            // SQLite cannot make its shared-memory file. Nobody writes there, so it can be read as it lies,
            // unless the log has the rest.
            const int code = failure.getErrorCode();
            if (code != SQLITE_CANTOPEN && code != SQLITE_READONLY) throw;
        }
        if (hasPendingLog(path)) {
            return base::Error{"The last generations of the study " + path.string() + " are still in " +
                               sidePath(path, "-wal").string() +
                               ", and the folder cannot be written. Copy both files into a folder that you "
                               "can write, and open the copy."};
        }
        return openReader(path, true);
    });
}

void settle(SQLite::Database& database) noexcept {
    // Readers may be there for long: do not wait for them.
    sqlite3_busy_timeout(database.getHandle(), 0);
    database.tryExec("PRAGMA journal_mode = DELETE");
}

}  // namespace trapwright::store
