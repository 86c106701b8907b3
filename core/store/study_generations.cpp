#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>

#include "core/store/packing.h"
#include "core/store/study_state.h"

namespace trapwright::store {

namespace {

constexpr const char* kIndividualColumns =
    "points, lengths, strategy, collision, distance, orientation, overlaps, trials, finished, fell_off, "
    "stuck, oriented";

void bindBlob(SQLite::Statement& statement, int index, const std::string& blob) {
    statement.bind(index, blob.data(), static_cast<int>(blob.size()));
}

template <class T>
void bindOptional(SQLite::Statement& statement, int index, const std::optional<T>& value) {
    if (value) {
        statement.bind(index, *value);
    } else {
        statement.bind(index);  // NULL
    }
}

void insertIndividual(SQLite::Statement& statement, int generation, int number,
                      const study::IndividualRecord& record) {
    statement.reset();
    statement.bind(1, generation);
    statement.bind(2, number);
    bindBlob(statement, 3, packBits(record.chromosome.points));
    bindBlob(statement, 4, packBits(record.chromosome.lengths));
    bindBlob(statement, 5, packBits(record.chromosome.strategy));
    statement.bind(6, record.fitness.collision);
    statement.bind(7, record.fitness.distance);
    statement.bind(8, record.fitness.orientation);
    statement.bind(9, record.overlaps);
    statement.bind(10, record.trials);
    statement.bind(11, record.finished);
    statement.bind(12, record.fellOff);
    statement.bind(13, record.stuck);
    bindOptional(statement, 14, record.oriented);
    statement.exec();
}

/// The columns of kIndividualColumns from `first` on; none if a gene is no gene, or a count none.
std::optional<study::IndividualRecord> readIndividual(const SQLite::Statement& query, int first) {
    auto points = unpackBits(readBlob(query, first));
    auto lengths = unpackBits(readBlob(query, first + 1));
    auto strategy = unpackBits(readBlob(query, first + 2));
    if (!points || !lengths || !strategy) return std::nullopt;
    study::IndividualRecord record;
    record.chromosome = {std::move(*points), std::move(*lengths), std::move(*strategy)};
    record.fitness = readFitness(query, first + 3);
    record.overlaps = query.getColumn(first + 6).getInt();
    record.trials = query.getColumn(first + 7).getInt();
    record.finished = query.getColumn(first + 8).getInt();
    record.fellOff = query.getColumn(first + 9).getInt();
    record.stuck = query.getColumn(first + 10).getInt();
    const auto oriented = query.getColumn(first + 11);
    if (!oriented.isNull()) record.oriented = oriented.getInt();
    const bool counted = areCounts(record.trials, {record.finished, record.fellOff, record.stuck});
    if (!counted || record.overlaps < 0 || !areCounts(record.trials, {record.oriented.value_or(0)}))
        return std::nullopt;
    return record;
}

constexpr const char* kSummaryQuery =
    "SELECT generation.number, winner, seconds, best_collision, best_distance, best_orientation, "
    "top_collision, "
    "top_distance, "
    "top_orientation, top_crossover, top_mutation, top_smoothing, "
    "(SELECT sum(trials) FROM individual WHERE individual.generation = generation.number), best.oriented, "
    "best.trials, top_success FROM generation LEFT JOIN individual AS best "
    "ON best.generation = generation.number AND best.number = generation.winner ";

base::Result<study::GenerationSummary> readSummary(const std::filesystem::path& path,
                                                   const SQLite::Statement& query) {
    study::GenerationSummary summary;
    summary.index = query.getColumn(0).getInt();
    summary.winner = query.getColumn(1).getInt();
    summary.seconds = query.getColumn(2).getDouble();
    summary.statistics.best = readFitness(query, 3);
    summary.statistics.topMean = readFitness(query, 6);
    summary.statistics.topStrategy = {query.getColumn(9).getDouble(), query.getColumn(10).getDouble(),
                                      query.getColumn(11).getDouble()};
    summary.trials = query.getColumn(12).getInt64();
    const auto oriented = query.getColumn(13);
    const int trials = query.getColumn(14).getInt();
    if (!oriented.isNull() && trials > 0) {
        if (!areCounts(trials, {oriented.getInt()}))
            return damagedValue(path, "the winner of generation " + std::to_string(summary.index));
        summary.statistics.success = {oriented.getInt(), trials};
    }
    const auto topSuccess = query.getColumn(15);
    if (!topSuccess.isNull()) summary.statistics.topSuccess = topSuccess.getDouble();
    return summary;
}

std::string nameOf(int generation, int individual) {
    return "individual " + std::to_string(individual) + " of generation " + std::to_string(generation);
}

base::Result<std::vector<study::Individual>> readWinners(SQLite::Database& database,
                                                         const std::filesystem::path& path,
                                                         const std::string& condition) {
    SQLite::Statement query(database, std::string("SELECT generation, individual.number, ") +
                                          kIndividualColumns +
                                          " FROM generation JOIN individual ON individual.generation = "
                                          "generation.number AND individual.number = generation.winner " +
                                          condition + "ORDER BY generation");
    std::vector<study::Individual> winners;
    while (query.executeStep()) {
        const int generation = query.getColumn(0).getInt();
        const int number = query.getColumn(1).getInt();
        auto record = readIndividual(query, 2);
        if (!record) return damagedValue(path, nameOf(generation, number));
        winners.push_back({generation, number, std::move(*record)});
    }
    return winners;
}

}  // namespace

base::Status StudyFile::saveGeneration(const study::GenerationRecord& record) {
    const std::string doing = "Generation " + std::to_string(record.index) + " could not be saved";
    return state_->save(doing, [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        const int count = state_->countRows("generation");
        if (record.index != count) {
            return base::Error{doing + ": the study " + path().string() + " has " + std::to_string(count) +
                               " generations, and the next one must have that number."};
        }
        SQLite::Statement generation(
            database, "INSERT INTO generation VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        const study::GenerationStatistics& s = record.statistics;
        SQLite::bind(generation, record.index, state_->program, record.winner, s.best.collision,
                     s.best.distance, s.best.orientation, s.topMean.collision, s.topMean.distance,
                     s.topMean.orientation, s.topStrategy.crossover, s.topStrategy.mutation,
                     s.topStrategy.smoothing, record.seconds);
        bindOptional(generation, 14, s.topSuccess);
        generation.exec();
        SQLite::Statement individual(
            database, "INSERT INTO individual VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        for (std::size_t i = 0; i < record.individuals.size(); ++i) {
            insertIndividual(individual, record.index, static_cast<int>(i), record.individuals[i]);
        }
        transaction.commit();
        return base::success();
    });
}

base::Result<int> StudyFile::generationCount() const {
    return guarded(path(), "The study could not be read",
                   [&]() -> base::Result<int> { return state_->countRows("generation"); });
}

base::Result<study::GenerationRecord> StudyFile::loadGeneration(int index) const {
    const std::string doing = "Generation " + std::to_string(index) + " could not be read";
    return guarded(path(), doing, [&]() -> base::Result<study::GenerationRecord> {
        SQLite::Statement head(*state_->database, std::string(kSummaryQuery) + "WHERE generation.number = ?");
        head.bind(1, index);
        if (!head.executeStep()) {
            return base::Error{doing + ": the study " + path().string() + " has " +
                               std::to_string(state_->countRows("generation")) +
                               " generations, counted from 0."};
        }
        const auto summary = readSummary(path(), head);
        if (!summary) return summary.error();
        study::GenerationRecord record;
        record.index = summary->index;
        record.winner = summary->winner;
        record.statistics = summary->statistics;
        record.seconds = summary->seconds;

        SQLite::Statement query(*state_->database,
                                std::string("SELECT ") + kIndividualColumns +
                                    " FROM individual WHERE generation = ? ORDER BY number");
        query.bind(1, index);
        while (query.executeStep()) {
            auto individual = readIndividual(query, 0);
            if (!individual)
                return damagedValue(path(), nameOf(index, static_cast<int>(record.individuals.size())));
            record.individuals.push_back(std::move(*individual));
        }
        const int count = static_cast<int>(record.individuals.size());
        if (record.winner < 0 || record.winner >= count)
            return damagedValue(path(), "the winner of generation " + std::to_string(index));
        return record;
    });
}

base::Result<study::IndividualRecord> StudyFile::loadIndividual(int generation, int individual) const {
    const std::string name = nameOf(generation, individual);
    return guarded(path(), "The " + name + " could not be read",
                   [&]() -> base::Result<study::IndividualRecord> {
                       SQLite::Statement query(*state_->database,
                                               std::string("SELECT ") + kIndividualColumns +
                                                   " FROM individual WHERE generation = ? AND number = ?");
                       SQLite::bind(query, generation, individual);
                       if (!query.executeStep()) {
                           return base::Error{"The study " + path().string() + " has no " + name +
                                              "; it has " + std::to_string(state_->countRows("generation")) +
                                              " generations. Generations and individuals count from 0."};
                       }
                       auto record = readIndividual(query, 0);
                       if (!record) return damagedValue(path(), name);
                       return std::move(*record);
                   });
}

base::Result<std::vector<study::GenerationSummary>> StudyFile::loadSummaries(int first) const {
    return guarded(path(), "The generations could not be read",
                   [&]() -> base::Result<std::vector<study::GenerationSummary>> {
                       SQLite::Statement query(*state_->database,
                                               std::string(kSummaryQuery) +
                                                   "WHERE generation.number >= ? ORDER BY generation.number");
                       query.bind(1, first);
                       std::vector<study::GenerationSummary> summaries;
                       while (query.executeStep()) {
                           auto summary = readSummary(path(), query);
                           if (!summary) return summary.error();
                           summaries.push_back(std::move(*summary));
                       }
                       return summaries;
                   });
}

base::Result<std::vector<study::Individual>> StudyFile::loadWinners() const {
    return guarded(path(), "The winners could not be read",
                   [&] { return readWinners(*state_->database, path(), ""); });
}

base::Result<std::vector<study::Individual>> StudyFile::loadUncheckedWinners() const {
    return guarded(path(), "The winners could not be read", [&] {
        return readWinners(*state_->database, path(),
                           "WHERE individual.trials > 0 AND NOT EXISTS (SELECT 1 FROM winner_check "
                           "WHERE winner_check.generation = generation.number) ");
    });
}

}  // namespace trapwright::store
