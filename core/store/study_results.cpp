#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>

#include <limits>

#include "core/store/scores.h"
#include "core/store/study_state.h"
#include "core/study/target.h"

namespace trapwright::store {

namespace {

study::SelectionEntry readEntry(const SQLite::Statement& query) {
    study::SelectionEntry entry;
    entry.generation = query.getColumn(0).getInt();
    entry.individual = query.getColumn(1).getInt();
    entry.fitness.total = query.getColumn(2).getDouble();
    entry.trials = query.getColumn(3).getInt();
    entry.finished = query.getColumn(4).getInt();
    entry.oriented = query.getColumn(5).getInt();
    entry.corners = {query.getColumn(12).getInt(), query.getColumn(11).getInt()};
    return entry;
}

/// None if its counts cannot be.
std::optional<study::ValidationRow> readRow(const SQLite::Statement& query) {
    study::ValidationRow row;
    row.pose = query.getColumn(0).getInt();
    const int trials = query.getColumn(1).getInt();
    const int failures = query.getColumn(2).getInt();
    trial::Tally& tally = row.tally;
    tally.wrongOrientation = query.getColumn(3).getInt();
    tally.stuck = query.getColumn(4).getInt();
    tally.fellOff = query.getColumn(5).getInt();
    const bool counted = areCounts(trials, {failures, tally.wrongOrientation, tally.stuck, tally.fellOff}) &&
                         areCounts(std::numeric_limits<int>::max(), {row.pose}) &&
                         failures == std::int64_t{tally.wrongOrientation} + tally.stuck + tally.fellOff;
    if (!counted) return std::nullopt;
    tally.success = trials - failures;
    return row;
}

/// Writes what the orientation that is shown does not say. A goal of one orientation has none.
SQLite::Statement makeGoalUpdate(SQLite::Database& database, const std::string& table,
                                 const std::string& condition) {
    return {database, "UPDATE " + table + " SET goal = ? WHERE " + condition};
}

/// The goal of JSON, or else the one orientation in the columns from `rotation` on. Whether it is one.
bool readGoal(const SQLite::Statement& query, int rotation, int json, trial::Goal& goal) {
    goal = trial::makeGoal(readRotation(query, rotation));
    if (query.getColumn(json).isNull()) return true;
    const auto read = study::goalFromJson(query.getColumn(json).getString());
    if (read) goal = *read;
    return read.ok();
}

void saveBox(SQLite::Database& database, const std::string& table, int number,
             const std::optional<trial::OperatingBox>& box) {
    if (!box) return;
    SQLite::Statement set(database, "UPDATE " + table + " SET box = ? WHERE number = ?");
    SQLite::bind(set, study::boxToJson(*box), number);
    set.exec();
}

/// Whether it is one, or none.
bool readBox(const SQLite::Statement& query, int column, std::optional<trial::OperatingBox>& box) {
    if (query.getColumn(column).isNull()) return true;
    const auto read = study::boxFromJson(query.getColumn(column).getString());
    if (read) box = *read;
    return read.ok();
}

}  // namespace

base::Status StudyFile::saveSelection(const study::SelectionRecord& record) {
    return state_->save("The selection could not be saved", [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        const int number = state_->countRows("selection");
        SQLite::Statement head(database, "INSERT INTO selection (number, program, engine) VALUES (?, ?, ?)");
        SQLite::bind(head, number, state_->program, record.engine);
        head.exec();
        saveBox(database, "selection", number, record.box);
        SQLite::Statement row(
            database,
            "INSERT INTO selection_entry (selection, rank, generation, individual, fitness, trials, "
            "finished, "
            "oriented, modal_w, modal_x, modal_y, modal_z, corner_trials, corner_oriented) "
            "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        ScoreWriter scores(database, kSelectionScores);
        int rank = 0;
        for (const study::SelectionEntry& e : record.entries) {
            const base::Quaternion& q = e.goal.shown();
            row.reset();
            SQLite::bind(row, number, rank, e.generation, e.individual, e.fitness.total, e.trials, e.finished,
                         e.oriented, q.w(), q.x(), q.y(), q.z(), e.corners.trials, e.corners.successes);
            row.exec();
            if (!e.goal.isOneOrientation()) {
                SQLite::Statement goal =
                    makeGoalUpdate(database, "selection_entry", "selection = ? AND rank = ?");
                SQLite::bind(goal, study::goalToJson(e.goal), number, rank);
                goal.exec();
            }
            scores.write({number, rank++}, e.fitness.scores);
        }
        saveOutcomes(database, state_->program, OutcomeRun::selection, number, record.made);
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<study::SelectionRecord>> StudyFile::loadSelections() const {
    return guarded(
        path(), "The selections could not be read",
        [&]() -> base::Result<std::vector<study::SelectionRecord>> {
            SQLite::Statement heads(*state_->database,
                                    "SELECT number, engine, box FROM selection ORDER BY number");
            SQLite::Statement rows(
                *state_->database,
                "SELECT generation, individual, fitness, trials, "
                "finished, oriented, modal_w, modal_x, modal_y, modal_z, goal, "
                "corner_trials, corner_oriented FROM selection_entry WHERE selection = ? ORDER BY rank");
            ScoreReader scores(*state_->database, kSelectionScores);
            std::vector<study::SelectionRecord> records;
            while (heads.executeStep()) {
                study::SelectionRecord record;
                record.engine = heads.getColumn(1).getString();
                if (!readBox(heads, 2, record.box))
                    return damagedValue(path(), "the operating box of a selection");
                rows.reset();
                const int number = heads.getColumn(0).getInt();
                rows.bind(1, number);
                while (rows.executeStep()) {
                    study::SelectionEntry entry = readEntry(rows);
                    if (!readGoal(rows, 6, 10, entry.goal))
                        return damagedValue(path(), "the goal of a selection");
                    auto own = scores.read({number, static_cast<int>(record.entries.size())});
                    if (!own || !areCounts(entry.trials, {entry.finished, entry.oriented}) ||
                        !areCounts(entry.corners.trials, {entry.corners.successes}))
                        return damagedValue(path(), "the counts of a selection");
                    entry.fitness.scores = std::move(*own);
                    record.entries.push_back(std::move(entry));
                }
                records.push_back(std::move(record));
            }
            return records;
        });
}

base::Status StudyFile::saveValidation(const study::ValidationRecord& record) {
    return state_->save("The validation could not be saved", [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        const int number = state_->countRows("validation");
        const base::Quaternion& q = record.goal.shown();
        SQLite::Statement head(
            database,
            "INSERT INTO validation (number, program, engine, generation, individual, expected_w, "
            "expected_x, expected_y, expected_z, tolerance) "
            "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        SQLite::bind(head, number, state_->program, record.engine, record.generation, record.individual,
                     q.w(), q.x(), q.y(), q.z(), record.tolerance);
        head.exec();
        saveBox(database, "validation", number, record.box);
        if (!record.goal.isOneOrientation()) {
            SQLite::Statement goal = makeGoalUpdate(database, "validation", "number = ?");
            SQLite::bind(goal, study::goalToJson(record.goal), number);
            goal.exec();
        }
        SQLite::Statement row(database, "INSERT INTO validation_row VALUES (?, ?, ?, ?, ?, ?, ?)");
        for (const study::ValidationRow& r : record.rows) {
            row.reset();
            const trial::Tally& tally = r.tally;
            SQLite::bind(row, number, r.pose, tally.trials(), tally.failures(), tally.wrongOrientation,
                         tally.stuck, tally.fellOff);
            row.exec();
        }
        saveOutcomes(database, state_->program, OutcomeRun::validation, number, record.made);
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<study::ValidationRecord>> StudyFile::loadValidations() const {
    return guarded(path(), "The validations could not be read",
                   [&]() -> base::Result<std::vector<study::ValidationRecord>> {
                       SQLite::Statement heads(
                           *state_->database,
                           "SELECT number, engine, generation, individual, expected_w, expected_x, "
                           "expected_y, expected_z, tolerance, box, goal FROM validation ORDER BY number");
                       SQLite::Statement rows(
                           *state_->database,
                           "SELECT pose, trials, failures, wrong_orientation, stuck, fell_off "
                           "FROM validation_row WHERE validation = ? ORDER BY pose");
                       std::vector<study::ValidationRecord> records;
                       while (heads.executeStep()) {
                           study::ValidationRecord record;
                           record.engine = heads.getColumn(1).getString();
                           record.generation = heads.getColumn(2).getInt();
                           record.individual = heads.getColumn(3).getInt();
                           if (!readGoal(heads, 4, 10, record.goal))
                               return damagedValue(path(), "the goal of a validation");
                           record.tolerance = heads.getColumn(8).getDouble();
                           if (!readBox(heads, 9, record.box))
                               return damagedValue(path(), "the operating box of a validation");
                           rows.reset();
                           rows.bind(1, heads.getColumn(0).getInt());
                           while (rows.executeStep()) {
                               const auto row = readRow(rows);
                               if (!row) return damagedValue(path(), "the counts of a validation");
                               record.rows.push_back(*row);
                           }
                           records.push_back(std::move(record));
                       }
                       return records;
                   });
}

base::Status StudyFile::saveRobustness(const study::RobustnessRecord& record) {
    return state_->save("The robustness could not be saved", [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        SQLite::Statement row(database, "INSERT OR REPLACE INTO robustness VALUES (?, ?, ?, ?, ?, ?)");
        SQLite::bind(row, record.generation, record.individual, state_->program, record.engine,
                     study::boxToJson(record.box), study::robustnessToJson(record.robustness));
        row.exec();
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<study::RobustnessRecord>> StudyFile::loadRobustness() const {
    return guarded(path(), "The robustness of the tracks could not be read",
                   [&]() -> base::Result<std::vector<study::RobustnessRecord>> {
                       SQLite::Statement rows(*state_->database,
                                              "SELECT generation, individual, engine, box, result "
                                              "FROM robustness ORDER BY generation, individual");
                       std::vector<study::RobustnessRecord> records;
                       while (rows.executeStep()) {
                           study::RobustnessRecord record;
                           record.generation = rows.getColumn(0).getInt();
                           record.individual = rows.getColumn(1).getInt();
                           record.engine = rows.getColumn(2).getString();
                           const auto box = study::boxFromJson(rows.getColumn(3).getString());
                           auto robustness = study::robustnessFromJson(rows.getColumn(4).getString());
                           if (!box || !robustness) return damagedValue(path(), "the robustness of a track");
                           record.box = *box;
                           record.robustness = std::move(*robustness);
                           records.push_back(std::move(record));
                       }
                       return records;
                   });
}

base::Status StudyFile::saveStreams(const study::StreamsRecord& record) {
    return state_->save("The streams could not be saved", [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        SQLite::Statement row(database, "INSERT OR REPLACE INTO stream VALUES (?, ?, ?, ?, ?, ?)");
        SQLite::bind(row, record.generation, record.individual, state_->program, record.engine);
        if (record.box) row.bind(5, study::boxToJson(*record.box));
        row.bind(6, study::streamsToJson(record.streams));
        row.exec();
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<study::StreamsRecord>> StudyFile::loadStreams() const {
    return guarded(path(), "The streams could not be read",
                   [&]() -> base::Result<std::vector<study::StreamsRecord>> {
                       SQLite::Statement rows(*state_->database,
                                              "SELECT generation, individual, engine, box, result "
                                              "FROM stream ORDER BY generation, individual");
                       std::vector<study::StreamsRecord> records;
                       while (rows.executeStep()) {
                           study::StreamsRecord record;
                           record.generation = rows.getColumn(0).getInt();
                           record.individual = rows.getColumn(1).getInt();
                           record.engine = rows.getColumn(2).getString();
                           if (!rows.getColumn(3).isNull()) {
                               const auto box = study::boxFromJson(rows.getColumn(3).getString());
                               if (!box) return damagedValue(path(), "the operating box of streams");
                               record.box = *box;
                           }
                           auto streams = study::streamsFromJson(rows.getColumn(4).getString());
                           if (!streams) return damagedValue(path(), "the streams on a track");
                           record.streams = std::move(*streams);
                           records.push_back(std::move(record));
                       }
                       return records;
                   });
}

}  // namespace trapwright::store
