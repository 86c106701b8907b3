#include "core/store/study_file.h"

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <system_error>

#include "core/base/file.h"
#include "core/search/design_space.h"
#include "core/store/packing.h"
#include "core/store/schema.h"
#include "core/store/study_state.h"

namespace trapwright::store {

namespace {

void writeSettings(SQLite::Database& database, const study::Settings& settings) {
    SQLite::Statement update(database, "UPDATE study SET settings = ?, seed = ?");
    SQLite::bind(update, study::toJson(settings), std::to_string(settings.evolution.seed));
    update.exec();
}

void writePart(SQLite::Database& database, const StoredPart& part) {
    SQLite::Statement row(database, "INSERT OR REPLACE INTO part VALUES (1, ?, ?, ?, ?, ?, ?, ?)");
    const std::string vertices = packVertices(part.mesh.vertices);
    const std::string triangles = packTriangles(part.mesh.triangles);
    SQLite::bind(row, part.options.name, part.options.source, part.options.density,
                 part.options.symmetryTolerance);
    row.bindNoCopy(5, vertices.data(), static_cast<int>(vertices.size()));
    row.bindNoCopy(6, triangles.data(), static_cast<int>(triangles.size()));
    row.bind(7, part.options.symmetry == part::SymmetryUse::none ? 0 : 1);
    row.exec();
}

void writeNewStudy(SQLite::Database& database, const study::Settings& settings, const StoredPart& part,
                   const std::string& program) {
    database.exec("PRAGMA synchronous = FULL");
    database.exec("PRAGMA application_id = " + std::to_string(kApplicationId));
    migrate(database, schemaMigrations());

    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
    SQLite::Statement origin(database, "INSERT INTO study VALUES (1, ?, ?, '', '')");
    SQLite::bind(origin, program, currentUtc());
    origin.exec();
    writeSettings(database, settings);

    writePart(database, part);
    transaction.commit();
}

/// An empty file of a name that nobody has, beside the study that is to be made. An error tells the system's
/// reason.
base::Result<std::filesystem::path> beginUnfinished(const std::filesystem::path& path) {
    constexpr int kMostTries = 1000;
    int reason = EEXIST;
    for (int number = 0; number < kMostTries && reason == EEXIST; ++number) {
        std::filesystem::path unfinished = std::filesystem::absolute(path);
        unfinished += ".new-" + std::to_string(::getpid()) + "-" + std::to_string(number);
        const int descriptor = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            ::close(descriptor);
            return unfinished;
        }
        reason = errno;
    }
    return base::Error{"The study " + path.string() + " could not be made (" +
                       std::generic_category().message(reason) + "). Use a folder that you can write."};
}

void removeUnfinished(const std::filesystem::path& path) {
    std::error_code missing;
    std::filesystem::remove(path, missing);
    std::filesystem::path journal = path;
    journal += "-journal";
    std::filesystem::remove(journal, missing);
}

/// Puts a new study, which `write` writes, where `path` is, and holds its lock. It is written beside and
/// renamed, so that a study is either whole or not there.
template <class Write>
base::Result<FileLock> placeNew(const std::filesystem::path& path, const Write& write) {
    std::error_code missing;
    const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
    if (!std::filesystem::is_directory(folder, missing)) {
        return base::Error{"The study " + path.string() + " cannot be made: there is no folder " +
                           folder.string() + ". Make that first."};
    }
    const auto refuseExisting = [&] {
        return base::Error{
            path.string() +
            " exists already. Choose another name for the new study, or go on with the old one."};
    };
    if (std::filesystem::exists(std::filesystem::symlink_status(path, missing))) return refuseExisting();
    auto lock = FileLock::acquire(path);
    if (!lock) return lock;
    // SQLite would take the old study's log for that of the new one, and mix the two.
    if (hasPendingLog(path)) {
        return base::Error{"The study " + path.string() + " cannot be made: " + path.string() +
                           "-wal is there, the log of a study of that name that is gone. Delete it, or put "
                           "that study back and open it once."};
    }

    const auto begun = beginUnfinished(path);
    if (!begun) return begun.error();
    const std::filesystem::path& unfinished = *begun;
    const auto made = guarded(path, "The study could not be made", [&]() -> base::Status {
        write(unfinished);
        return base::success();
    });
    std::error_code failure;
    if (made.ok() && std::filesystem::exists(std::filesystem::symlink_status(path, missing))) {
        removeUnfinished(unfinished);
        return refuseExisting();
    }
    if (made.ok()) std::filesystem::rename(unfinished, path, failure);
    if (!made.ok() || failure) {
        removeUnfinished(unfinished);
        if (!made.ok()) return made.error();
        return base::Error{"The study " + path.string() + " could not be made (" + failure.message() + ")."};
    }
    base::syncFolder(folder);
    return lock;
}

}  // namespace

base::Error damagedValue(const std::filesystem::path& path, const std::string& what) {
    return {
        "The study " + path.string() + " is damaged: " + what + " cannot be read. Restore it from a copy.",
        base::ErrorKind::damaged};
}

bool areCounts(int whole, std::initializer_list<int> parts) {
    return whole >= 0 && std::ranges::all_of(parts, [&](int part) { return part >= 0 && part <= whole; });
}

base::Quaternion readRotation(const SQLite::Statement& statement, int first) {
    return {statement.getColumn(first).getDouble(), statement.getColumn(first + 1).getDouble(),
            statement.getColumn(first + 2).getDouble(), statement.getColumn(first + 3).getDouble()};
}

std::string readBlob(const SQLite::Statement& statement, int column) {
    return statement.getColumn(column).getString();
}

std::string currentUtc() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::array<char, 32> text{};
    const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    return {text.data(), length};
}

StudyFile::State::~State() {
    if (database && lock) settle(*database);
}

base::Status StudyFile::State::checkWritable() const {
    if (!lock) {
        return base::Error{"The study " + path.string() +
                           " is open for reading only, so nothing can be saved in it."};
    }
    return checkInPlace();
}

base::Status StudyFile::State::checkInPlace() const {
    if (isInPlace(*database)) return base::success();
    std::error_code missing;
    const bool replaced = std::filesystem::exists(path, missing);
    return base::Error{
        "The study " + path.string() + " was " +
            (replaced ? "replaced by another file" : "deleted or moved") +
            " while it was open, so that nothing more can be saved in it. What was saved until then "
            "can still be copied.",
        base::ErrorKind::cannotWrite};
}

int StudyFile::State::countRows(const std::string& table) const {
    return database->execAndGet("SELECT count(*) FROM " + table).getInt();
}

StudyFile::StudyFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
StudyFile::StudyFile(StudyFile&&) noexcept = default;
StudyFile& StudyFile::operator=(StudyFile&&) noexcept = default;
StudyFile::~StudyFile() = default;

base::Result<StudyFile> StudyFile::create(const std::filesystem::path& path, const study::Settings& settings,
                                          const StoredPart& part, const std::string& program) {
    auto lock = placeNew(path, [&](const std::filesystem::path& unfinished) {
        SQLite::Database database(unfinished.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        writeNewStudy(database, settings, part, program);
    });
    if (!lock) return lock.error();
    return openLocked(path, program, std::move(lock).value());
}

base::Result<StudyFile> StudyFile::open(const std::filesystem::path& path, const std::string& program) {
    // What is plainly no study gets no lock beside it.
    {
        const auto file = OpenFile::open(path);
        if (!file) return file.error();
        if (const auto checked = checkStudyFile(path, *file); !checked) return checked.error();
    }
    auto lock = FileLock::acquire(path);
    if (!lock) return lock.error();
    return openLocked(path, program, std::move(lock).value());
}

base::Result<StudyFile> StudyFile::openLocked(const std::filesystem::path& path, const std::string& program,
                                              FileLock lock) {
    auto file = OpenFile::open(path);
    if (!file) return file.error();
    if (const auto checked = checkStudyFile(path, *file); !checked) return checked.error();
    if (const auto locked = file->lockForWriting(); !locked) return locked.error();
    if (const auto log = checkOneLog(path, *file); !log) return log.error();
    auto state = std::make_unique<State>();
    state->path = path;
    state->program = program;
    state->lock = std::make_shared<FileLock>(std::move(lock));
    state->file = std::make_shared<OpenFile>(std::move(file).value());
    auto database = openForWriting(path);
    if (!database) return database.error();
    state->database = std::move(database).value();
    return StudyFile(std::move(state));
}

base::Result<StudyFile> StudyFile::openReadOnly(const std::filesystem::path& path) {
    auto file = OpenFile::open(path);
    if (!file) return file.error();
    if (const auto checked = checkStudyFile(path, *file); !checked) return checked.error();
    if (const auto log = checkOneLog(path, *file); !log) return log.error();
    auto state = std::make_unique<State>();
    state->path = path;
    state->file = std::make_shared<OpenFile>(std::move(file).value());
    auto database = openForReading(path);
    if (!database) return database.error();
    state->database = std::move(database).value();
    return StudyFile(std::move(state));
}

base::Result<StudyFile> StudyFile::openBeside() const {
    if (const auto writable = state_->checkWritable(); !writable) return writable.error();
    auto database = store::openBeside(path());
    if (!database) return database.error();
    auto state = std::make_unique<State>();
    state->path = state_->path;
    state->program = state_->program;
    state->lock = state_->lock;
    state->file = state_->file;
    state->database = std::move(database).value();
    return StudyFile(std::move(state));
}

const std::filesystem::path& StudyFile::path() const {
    return state_->path;
}

bool StudyFile::writable() const {
    return state_->lock != nullptr;
}

base::Result<study::Settings> StudyFile::loadSettings() const {
    return guarded(path(), "The settings could not be read", [&]() -> base::Result<study::Settings> {
        const std::string json = state_->database->execAndGet("SELECT settings FROM study").getString();
        auto settings = study::settingsFromJson(json, study::Settings{});
        if (!settings) return base::Error{"The study " + path().string() + ": " + settings.error().message};
        return settings;
    });
}

base::Result<StoredPart> StudyFile::loadPart() const {
    return guarded(path(), "The part could not be read", [&]() -> base::Result<StoredPart> {
        SQLite::Statement query(*state_->database,
                                "SELECT name, source, density, symmetry_tolerance, vertices, triangles, "
                                "symmetry_counts FROM part");
        if (!query.executeStep()) return damagedValue(path(), "its part");
        StoredPart part;
        part.options.name = query.getColumn(0).getString();
        part.options.source = query.getColumn(1).getString();
        part.options.density = query.getColumn(2).getDouble();
        part.options.symmetryTolerance = query.getColumn(3).getDouble();
        part.options.symmetry =
            query.getColumn(6).getInt() == 0 ? part::SymmetryUse::none : part::SymmetryUse::found;
        auto vertices = unpackVertices(readBlob(query, 4));
        if (!vertices) return damagedValue(path(), "the part's mesh");
        auto triangles = unpackTriangles(readBlob(query, 5), vertices->size());
        if (!triangles) return damagedValue(path(), "the part's mesh");
        part.mesh = {std::move(*vertices), std::move(*triangles)};
        return part;
    });
}

base::Status StudyFile::changeSettings(const study::Settings& settings) {
    const auto present = loadSettings();
    if (!present) return present.error();
    return state_->save("The settings could not be saved", [&]() -> base::Status {
        const int generations = state_->countRows("generation");
        if (generations > 0 && !study::keepsScores(*present, settings, generations)) {
            return base::Error{
                "The study " + path().string() +
                " has generations that were made with its settings. Only evolution.generations, corners of "
                "the "
                "operating box in generations to come (evolution.cornerShare, evolution.cornersFrom and "
                "corners in evolution.objectives) and the validation and feeder settings can change now; "
                "make a new study for the others."};
        }
        SQLite::Transaction transaction(*state_->database, SQLite::TransactionBehavior::IMMEDIATE);
        writeSettings(*state_->database, settings);
        transaction.commit();
        return base::success();
    });
}

base::Status StudyFile::changePart(const StoredPart& part, const study::Settings& settings) {
    return state_->save("The part could not be saved", [&]() -> base::Status {
        if (state_->countRows("generation") > 0) {
            return base::Error{"The study " + path().string() +
                               " has generations that were made with its part. Make a new study for another "
                               "one."};
        }
        SQLite::Transaction transaction(*state_->database, SQLite::TransactionBehavior::IMMEDIATE);
        writePart(*state_->database, part);
        writeSettings(*state_->database, settings);
        transaction.commit();
        return base::success();
    });
}

base::Status StudyFile::saveKnownTracks(const study::KnownTracks& tracks, const study::Settings& settings) {
    return state_->save("The tracks to begin with could not be saved", [&]() -> base::Status {
        if (state_->countRows("generation") > 0) {
            return base::Error{"The study " + path().string() +
                               " has begun already. Make a new study to begin with other tracks."};
        }
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        database.exec("DELETE FROM known_track; DELETE FROM known_trait");
        SQLite::Statement row(database, "INSERT INTO known_track VALUES (?, ?, ?)");
        SQLite::Statement trait(database, "INSERT INTO known_trait VALUES (?, ?, ?)");
        for (int i = 0; i < static_cast<int>(tracks.tracks.size()); ++i) {
            const search::Proposal& track = tracks.tracks[static_cast<std::size_t>(i)];
            const std::string design = search::packDesign(track.design);
            row.reset();
            row.bind(1, i);
            row.bind(2, tracks.study);
            row.bind(3, design.data(), static_cast<int>(design.size()));
            row.exec();
            for (const search::NamedNumber& one : track.traits) {
                trait.reset();
                SQLite::bind(trait, i, one.key, one.value);
                trait.exec();
            }
        }
        writeSettings(database, settings);
        transaction.commit();
        return base::success();
    });
}

base::Result<study::KnownTracks> StudyFile::loadKnownTracks() const {
    return guarded(
        path(), "The tracks to begin with could not be read", [&]() -> base::Result<study::KnownTracks> {
            SQLite::Statement rows(*state_->database,
                                   "SELECT number, study, design FROM known_track ORDER BY number");
            SQLite::Statement traits(*state_->database,
                                     "SELECT key, value FROM known_trait WHERE number = ? ORDER BY rowid");
            study::KnownTracks known;
            while (rows.executeStep()) {
                known.study = rows.getColumn(1).getString();
                auto design = search::unpackDesign(readBlob(rows, 2));
                if (!design || (!known.tracks.empty() && design->size() != known.tracks[0].design.size()))
                    return damagedValue(path(), "a track to begin with");
                search::Proposal& track = known.tracks.emplace_back();
                track.design = std::move(*design);
                traits.reset();
                traits.bind(1, rows.getColumn(0).getInt());
                while (traits.executeStep())
                    track.traits.push_back(
                        {traits.getColumn(0).getString(), traits.getColumn(1).getDouble()});
            }
            return known;
        });
}

base::Status StudyFile::checkInPlace() const {
    return state_->checkInPlace();
}

base::Result<std::filesystem::path> StudyFile::rescue() const {
    constexpr int kMostTries = 1000;
    std::error_code missing;
    for (int number = 1; number <= kMostTries; ++number) {
        std::filesystem::path copy = path().parent_path() / path().stem();
        copy += number == 1 ? std::string("-rescued") : "-rescued-" + std::to_string(number);
        copy += path().extension();
        if (std::filesystem::exists(std::filesystem::symlink_status(copy, missing))) continue;
        if (const auto copied = copyTo(copy); !copied) return copied.error();
        return copy;
    }
    return base::Error{"There are too many rescued copies beside " + path().string() + ". Move them away."};
}

base::Status StudyFile::copyTo(const std::filesystem::path& path) const {
    const auto placed = placeNew(path, [&](const std::filesystem::path& unfinished) {
        SQLite::Statement copy(*state_->database, "VACUUM INTO ?");
        copy.bind(1, unfinished.string());
        copy.exec();
    });
    if (!placed) return placed.error();
    return base::success();
}

}  // namespace trapwright::store
