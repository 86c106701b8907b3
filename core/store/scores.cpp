#include "core/store/scores.h"

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace trapwright::store {

namespace {

std::string makeInsert(const ScoreTable& table) {
    const std::size_t columns = table.owner.size() + (table.hasErrors ? 3 : 2);
    std::string marks;
    for (std::size_t i = 0; i < columns; ++i)
        marks += i == 0 ? "?" : ", ?";
    return fmt::format("INSERT INTO {} VALUES ({})", table.name, marks);
}

std::string makeSelect(const ScoreTable& table) {
    std::string condition;
    for (const std::string_view column : table.owner)
        condition += fmt::format("{}{} = ?", condition.empty() ? "" : " AND ", column);
    return fmt::format(
        "SELECT key, value, {} FROM {} LEFT JOIN objective ON objective.place = {}.objective WHERE {} "
        "ORDER BY objective",
        table.hasErrors ? "error" : "0", table.name, table.name, condition);
}

/// The keys in the order of their places. Throws SQLite::Exception if a place is missing.
std::vector<std::string> readKeys(SQLite::Database& database) {
    std::vector<std::string> keys;
    SQLite::Statement query(database, "SELECT place, key FROM objective ORDER BY place");
    while (query.executeStep()) {
        if (query.getColumn(0).getInt64() != static_cast<std::int64_t>(keys.size()))
            throw SQLite::Exception("an objective is missing", SQLITE_CORRUPT);
        keys.push_back(query.getColumn(1).getString());
    }
    return keys;
}

}  // namespace

struct ScoreWriter::State {
    State(SQLite::Database& its, const ScoreTable& table)
        : database(&its), keys(readKeys(its)), hasErrors(table.hasErrors), insert(its, makeInsert(table)) {}

    int placeOf(const std::string& key) {
        const auto found = std::find(keys.begin(), keys.end(), key);
        const int place = static_cast<int>(found - keys.begin());
        if (found != keys.end()) return place;
        SQLite::Statement add(*database, "INSERT INTO objective VALUES (?, ?)");
        SQLite::bind(add, place, key);
        add.exec();
        keys.push_back(key);
        return place;
    }

    SQLite::Database* database;
    std::vector<std::string> keys;
    bool hasErrors;
    SQLite::Statement insert;
};

ScoreWriter::ScoreWriter(SQLite::Database& database, const ScoreTable& table)
    : state_(std::make_unique<State>(database, table)) {}

ScoreWriter::~ScoreWriter() = default;

void ScoreWriter::write(const std::vector<int>& owner, const std::vector<objectives::Score>& scores) {
    SQLite::Statement& insert = state_->insert;
    for (const objectives::Score& score : scores) {
        insert.reset();
        int column = 0;
        for (const int number : owner)
            insert.bind(++column, number);
        insert.bind(++column, state_->placeOf(score.key));
        insert.bind(++column, score.value);
        if (state_->hasErrors) insert.bind(++column, score.error);
        insert.exec();
    }
}

struct ScoreReader::State {
    State(SQLite::Database& database, const ScoreTable& table) : select(database, makeSelect(table)) {}

    SQLite::Statement select;
};

ScoreReader::ScoreReader(SQLite::Database& database, const ScoreTable& table)
    : state_(std::make_unique<State>(database, table)) {}

ScoreReader::~ScoreReader() = default;

std::optional<std::vector<objectives::Score>> ScoreReader::read(const std::vector<int>& owner) {
    SQLite::Statement& select = state_->select;
    select.reset();
    int column = 0;
    for (const int number : owner)
        select.bind(++column, number);
    std::vector<objectives::Score> scores;
    while (select.executeStep()) {
        if (select.getColumn(0).isNull()) return std::nullopt;
        scores.push_back({select.getColumn(0).getString(), select.getColumn(1).getDouble(),
                          select.getColumn(2).getDouble()});
    }
    return scores;
}

}  // namespace trapwright::store
