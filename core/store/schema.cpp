#include "core/store/schema.h"

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Transaction.h>

#include <array>
#include <string>

namespace trapwright::store {

namespace {

constexpr const char* kVersion1 = R"sql(
CREATE TABLE study (
    id INTEGER PRIMARY KEY CHECK (id = 1),
    program TEXT NOT NULL,          -- that made the file
    created TEXT NOT NULL,          -- UTC, ISO 8601
    seed TEXT NOT NULL,             -- unsigned 64 bits, decimal
    settings TEXT NOT NULL          -- JSON
);
CREATE TABLE part (
    id INTEGER PRIMARY KEY CHECK (id = 1),
    name TEXT NOT NULL,
    source TEXT NOT NULL,           -- original file
    density REAL NOT NULL,          -- kg/m^3
    symmetry_tolerance REAL NOT NULL,
    vertices BLOB NOT NULL,         -- as imported, m
    triangles BLOB NOT NULL
);
CREATE TABLE generation (
    number INTEGER PRIMARY KEY,     -- from 0
    program TEXT NOT NULL,          -- that computed it
    winner INTEGER NOT NULL,
    best_collision REAL NOT NULL, best_distance REAL NOT NULL, best_orientation REAL NOT NULL,
    top_collision REAL NOT NULL, top_distance REAL NOT NULL, top_orientation REAL NOT NULL,
    top_crossover REAL NOT NULL, top_mutation REAL NOT NULL, top_smoothing REAL NOT NULL,
    seconds REAL NOT NULL
);
CREATE TABLE individual (
    generation INTEGER NOT NULL REFERENCES generation (number),
    number INTEGER NOT NULL,        -- from 0
    points BLOB NOT NULL, lengths BLOB NOT NULL, strategy BLOB NOT NULL,
    collision REAL NOT NULL, distance REAL NOT NULL, orientation REAL NOT NULL,
    overlaps INTEGER NOT NULL,
    trials INTEGER NOT NULL, finished INTEGER NOT NULL, fell_off INTEGER NOT NULL, stuck INTEGER NOT NULL,
    PRIMARY KEY (generation, number)
) WITHOUT ROWID;
CREATE TABLE selection (
    number INTEGER PRIMARY KEY,     -- from 0
    program TEXT NOT NULL,
    engine TEXT NOT NULL
);
CREATE TABLE selection_entry (
    selection INTEGER NOT NULL REFERENCES selection (number),
    rank INTEGER NOT NULL,          -- best is 0
    generation INTEGER NOT NULL, individual INTEGER NOT NULL,
    collision REAL NOT NULL, distance REAL NOT NULL, orientation REAL NOT NULL,
    trials INTEGER NOT NULL, finished INTEGER NOT NULL, oriented INTEGER NOT NULL,
    modal_w REAL NOT NULL, modal_x REAL NOT NULL, modal_y REAL NOT NULL, modal_z REAL NOT NULL,
    PRIMARY KEY (selection, rank)
) WITHOUT ROWID;
CREATE TABLE validation (
    number INTEGER PRIMARY KEY,     -- from 0
    program TEXT NOT NULL,
    engine TEXT NOT NULL,
    generation INTEGER NOT NULL, individual INTEGER NOT NULL,
    expected_w REAL NOT NULL, expected_x REAL NOT NULL, expected_y REAL NOT NULL, expected_z REAL NOT NULL,
    tolerance REAL NOT NULL         -- rad
);
CREATE TABLE validation_row (
    validation INTEGER NOT NULL REFERENCES validation (number),
    pose INTEGER NOT NULL,          -- of the part's stable poses
    trials INTEGER NOT NULL, failures INTEGER NOT NULL,
    wrong_orientation INTEGER NOT NULL, stuck INTEGER NOT NULL, fell_off INTEGER NOT NULL,
    PRIMARY KEY (validation, pose)
) WITHOUT ROWID;
)sql";

// What studies of version 1 were learned with, whatever the defaults become.
constexpr const char* kVersion2 = R"sql(
CREATE TABLE winner_check (
    generation INTEGER PRIMARY KEY REFERENCES generation (number),
    individual INTEGER NOT NULL,    -- the winner
    program TEXT NOT NULL,
    trials INTEGER NOT NULL,        -- in each engine
    learning_engine TEXT NOT NULL,
    learning_collision REAL NOT NULL, learning_distance REAL NOT NULL, learning_orientation REAL NOT NULL,
    learning_finished INTEGER NOT NULL, learning_oriented INTEGER NOT NULL,
    reference_engine TEXT NOT NULL,
    reference_collision REAL NOT NULL, reference_distance REAL NOT NULL, reference_orientation REAL NOT NULL,
    reference_finished INTEGER NOT NULL, reference_oriented INTEGER NOT NULL
);
UPDATE study SET settings = json_set(settings, '$.evolution.racingTrials', 0,
    '$.evolution.racingShare', 0.3, '$.evolution.commonRandomNumbers', json('false'));
)sql";

// As patient while learning as afterwards.
constexpr const char* kVersion3 = R"sql(
UPDATE study SET settings = json_set(settings, '$.evolution.learningStuckTime_s',
    json_extract(settings, '$.simulation.termination.stuckTime_s'));
)sql";

constexpr std::array<Migration, 3> kMigrations = {{{1, kVersion1}, {2, kVersion2}, {3, kVersion3}}};

}  // namespace

std::span<const Migration> schemaMigrations() {
    return kMigrations;
}

int currentSchemaVersion() {
    return kMigrations.back().version;
}

void migrate(SQLite::Database& database, std::span<const Migration> migrations) {
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
    const int present = database.execAndGet("PRAGMA user_version").getInt();
    for (const Migration& migration : migrations) {
        if (migration.version <= present) continue;
        database.exec(migration.sql);
        database.exec("PRAGMA user_version = " + std::to_string(migration.version));
    }
    transaction.commit();
}

}  // namespace trapwright::store
