#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>

#include "core/store/scores.h"
#include "core/store/study_state.h"

namespace trapwright::store {

namespace {

constexpr int kLearning = 0;  // in the table of scores
constexpr int kReference = 1;

/// The four columns of one engine from `first` on, without its scores.
study::EngineScore readScore(const SQLite::Statement& query, int first) {
    study::EngineScore score;
    score.engine = query.getColumn(first).getString();
    score.fitness.total = query.getColumn(first + 1).getDouble();
    score.finished = query.getColumn(first + 2).getInt();
    score.oriented = query.getColumn(first + 3).getInt();
    return score;
}

study::CheckRecord readCheck(const SQLite::Statement& query) {
    study::CheckRecord record;
    record.generation = query.getColumn(0).getInt();
    record.individual = query.getColumn(1).getInt();
    record.trials = query.getColumn(2).getInt();
    record.learning = readScore(query, 3);
    record.reference = readScore(query, 7);
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
            database,
            "INSERT INTO winner_check (generation, individual, program, trials, learning_engine, "
            "learning_fitness, learning_finished, learning_oriented, reference_engine, reference_fitness, "
            "reference_finished, reference_oriented) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        const study::EngineScore& own = record.learning;
        const study::EngineScore& other = record.reference;
        SQLite::bind(row, record.generation, record.individual, state_->program, record.trials, own.engine,
                     own.fitness.total, own.finished, own.oriented, other.engine, other.fitness.total,
                     other.finished, other.oriented);
        row.exec();
        ScoreWriter scores(database, kCheckScores);
        scores.write({record.generation, kLearning}, own.fitness.scores);
        scores.write({record.generation, kReference}, other.fitness.scores);
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<study::CheckRecord>> StudyFile::loadChecks() const {
    return guarded(
        path(), "The checks could not be read", [&]() -> base::Result<std::vector<study::CheckRecord>> {
            SQLite::Statement query(
                *state_->database,
                "SELECT generation, individual, trials, learning_engine, learning_fitness, "
                "learning_finished, learning_oriented, reference_engine, reference_fitness, "
                "reference_finished, reference_oriented "
                "FROM winner_check ORDER BY generation");
            ScoreReader scores(*state_->database, kCheckScores);
            std::vector<study::CheckRecord> records;
            while (query.executeStep()) {
                auto record = readCheck(query);
                auto learned = scores.read({record.generation, kLearning});
                auto judged = scores.read({record.generation, kReference});
                const study::EngineScore& own = record.learning;
                const study::EngineScore& other = record.reference;
                if (!learned || !judged ||
                    !areCounts(record.trials, {own.finished, own.oriented, other.finished, other.oriented}))
                    return damagedValue(path(),
                                        "the check of generation " + std::to_string(record.generation));
                record.learning.fitness.scores = std::move(*learned);
                record.reference.fitness.scores = std::move(*judged);
                records.push_back(std::move(record));
            }
            return records;
        });
}

}  // namespace trapwright::store
