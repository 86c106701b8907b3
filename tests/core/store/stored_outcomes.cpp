#include "tests/core/store/stored_outcomes.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/trial/outcome_codec.h"

namespace trapwright::sample {

void changeOutcomes(const std::filesystem::path& path, int generation,
                    const std::function<void(std::size_t trial, trial::PartOutcome& outcome)>& change) {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
    SQLite::Statement query(
        database, "SELECT first, count, trials FROM outcomes WHERE run = 'generation' AND number = ?");
    query.bind(1, generation);
    while (query.executeStep()) {
        const int first = query.getColumn(0).getInt();
        auto outcomes = trial::unpackOutcomes(query.getColumn(2).getString(),
                                              static_cast<std::size_t>(query.getColumn(1).getInt()))
                            .value();
        for (std::size_t i = 0; i < outcomes.size(); ++i)
            change(static_cast<std::size_t>(first) + i, outcomes[i].parts.at(0));
        const std::string bytes = trial::packOutcomes(outcomes);
        SQLite::Statement update(
            database, "UPDATE outcomes SET trials = ? WHERE run = 'generation' AND number = ? AND first = ?");
        update.bind(1, bytes.data(), static_cast<int>(bytes.size()));
        update.bind(2, generation);
        update.bind(3, first);
        update.exec();
    }
}

void changeMaker(const std::filesystem::path& path, const trial::OutcomeMaker& maker) {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
    SQLite::Statement update(database,
                             "UPDATE outcome_maker SET program = ?, engine = ?, instruction_set = ?");
    update.bind(1, maker.program);
    update.bind(2, maker.engine);
    update.bind(3, maker.instructionSet);
    update.exec();
}

void dropOutcomes(const std::filesystem::path& path) {
    alter(path, "DELETE FROM outcomes; DELETE FROM outcome_maker");
}

void alter(const std::filesystem::path& path, const std::string& sql) {
    SQLite::Database(path.string(), SQLite::OPEN_READWRITE).exec(sql);
}

}  // namespace trapwright::sample
