#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>

#include <charconv>
#include <cstdint>
#include <limits>

#include "core/store/study_state.h"

namespace trapwright::store {

namespace {

base::Result<study::DropRecord> readHead(const std::filesystem::path& path, const SQLite::Statement& query) {
    study::DropRecord record;
    study::DropSettings& settings = record.settings;
    record.engine = query.getColumn(1).getString();
    settings.drops = query.getColumn(2).getInt();
    settings.height = query.getColumn(3).getDouble();
    settings.contact = {query.getColumn(4).getDouble(), query.getColumn(5).getDouble(),
                        query.getColumn(6).getDouble()};
    settings.gravity = query.getColumn(7).getDouble();
    const std::string seed = query.getColumn(8).getString();
    const auto [end, problem] = std::from_chars(seed.data(), seed.data() + seed.size(), settings.seed);
    if (problem != std::errc() || end != seed.data() + seed.size())
        return damagedValue(path, "the seed of a drop test");
    record.result.unsettled = query.getColumn(9).getInt();
    record.time = query.getColumn(10).getString();
    return record;
}

/// Whether each count can be one, and their sum a number of drops.
bool areDrops(const study::DropResult& result) {
    std::int64_t sum = result.unsettled;
    for (const int count : result.counts) {
        if (count < 0) return false;
        sum += count;
    }
    return result.unsettled >= 0 && sum <= std::numeric_limits<int>::max();
}

}  // namespace

base::Status StudyFile::addDropTest(const study::DropRecord& record) {
    return state_->save("The drop test could not be saved", [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        const int number = state_->countRows("drop_test");
        const study::DropSettings& settings = record.settings;
        SQLite::Statement head(database, "INSERT INTO drop_test VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        SQLite::bind(head, number, state_->program, record.engine, settings.drops, settings.height,
                     settings.contact.staticFriction, settings.contact.kineticFriction,
                     settings.contact.restitution, settings.gravity, std::to_string(settings.seed),
                     record.result.unsettled, record.time.empty() ? currentUtc() : record.time);
        head.exec();
        SQLite::Statement row(database, "INSERT INTO drop_pose VALUES (?, ?, ?, ?, ?, ?, ?)");
        for (std::size_t pose = 0; pose < record.poses.size(); ++pose) {
            const base::Quaternion& q = record.poses[pose];
            row.reset();
            SQLite::bind(row, number, static_cast<int>(pose), record.result.counts[pose], q.w(), q.x(), q.y(),
                         q.z());
            row.exec();
        }
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<study::DropRecord>> StudyFile::loadDropTests() const {
    return guarded(
        path(), "The drop tests could not be read", [&]() -> base::Result<std::vector<study::DropRecord>> {
            SQLite::Statement heads(
                *state_->database,
                "SELECT number, engine, drops, height, static_friction, kinetic_friction, "
                "restitution, gravity, seed, unsettled, time FROM drop_test ORDER BY number");
            SQLite::Statement rows(*state_->database,
                                   "SELECT count, w, x, y, z FROM drop_pose WHERE test = ? ORDER BY pose");
            std::vector<study::DropRecord> records;
            while (heads.executeStep()) {
                auto record = readHead(path(), heads);
                if (!record) return record.error();
                rows.reset();
                rows.bind(1, heads.getColumn(0).getInt());
                while (rows.executeStep()) {
                    record->result.counts.push_back(rows.getColumn(0).getInt());
                    record->poses.push_back(readRotation(rows, 1));
                }
                if (!areDrops(record->result)) return damagedValue(path(), "the counts of a drop test");
                records.push_back(std::move(*record));
            }
            return records;
        });
}

}  // namespace trapwright::store
