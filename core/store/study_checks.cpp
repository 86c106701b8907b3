#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>

#include "core/store/study_state.h"

namespace trapwright::store {

namespace {

/// The six columns of one engine from `first` on.
study::EngineScore readScore(const SQLite::Statement& query, int first) {
    return {query.getColumn(first).getString(), readFitness(query, first + 1),
            query.getColumn(first + 4).getInt(), query.getColumn(first + 5).getInt()};
}

study::CheckRecord readCheck(const SQLite::Statement& query) {
    study::CheckRecord record;
    record.generation = query.getColumn(0).getInt();
    record.individual = query.getColumn(1).getInt();
    record.trials = query.getColumn(2).getInt();
    record.learning = readScore(query, 3);
    record.reference = readScore(query, 9);
    return record;
}

}  // namespace

base::Status StudyFile::saveCheck(const study::CheckRecord& record) {
    const std::string doing =
        "The check of generation " + std::to_string(record.generation) + " could not be saved";
    return state_->save(doing, [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        SQLite::Statement present(database, "SELECT count(*) FROM winner_check WHERE generation = ?");
        present.bind(1, record.generation);
        present.executeStep();
        if (present.getColumn(0).getInt() > 0)
            return base::Error{doing + ": the study " + path().string() + " has one already."};
        SQLite::Statement row(
            database, "INSERT INTO winner_check VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        const study::EngineScore& own = record.learning;
        const study::EngineScore& other = record.reference;
        SQLite::bind(row, record.generation, record.individual, state_->program, record.trials, own.engine,
                     own.fitness.collision, own.fitness.distance, own.fitness.orientation, own.finished,
                     own.oriented, other.engine, other.fitness.collision, other.fitness.distance,
                     other.fitness.orientation, other.finished, other.oriented);
        row.exec();
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<study::CheckRecord>> StudyFile::loadChecks() const {
    return guarded(
        path(), "The checks could not be read", [&]() -> base::Result<std::vector<study::CheckRecord>> {
            SQLite::Statement query(
                *state_->database,
                "SELECT generation, individual, trials, learning_engine, learning_collision, "
                "learning_distance, learning_orientation, learning_finished, learning_oriented, "
                "reference_engine, reference_collision, reference_distance, "
                "reference_orientation, reference_finished, reference_oriented "
                "FROM winner_check ORDER BY generation");
            std::vector<study::CheckRecord> records;
            while (query.executeStep()) {
                auto record = readCheck(query);
                const study::EngineScore& own = record.learning;
                const study::EngineScore& other = record.reference;
                if (!areCounts(record.trials, {own.finished, own.oriented, other.finished, other.oriented}))
                    return damagedValue(path(),
                                        "the check of generation " + std::to_string(record.generation));
                records.push_back(std::move(record));
            }
            return records;
        });
}

}  // namespace trapwright::store
