#include "core/store/schema.h"

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Transaction.h>

#include <array>
#include <string>

#include "core/store/old_genes.h"

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

// The real feeder.
constexpr const char* kVersion4 = R"sql(
CREATE TABLE chosen_winner (
    id INTEGER PRIMARY KEY CHECK (id = 1),
    generation INTEGER NOT NULL, individual INTEGER NOT NULL
);
CREATE TABLE physical_validation (
    number INTEGER PRIMARY KEY,     -- from 0
    program TEXT NOT NULL,          -- that began it
    generation INTEGER NOT NULL, individual INTEGER NOT NULL,
    repetitions INTEGER NOT NULL,   -- of each pose
    shuffled INTEGER NOT NULL,      -- 0 or 1
    seed TEXT NOT NULL,             -- unsigned 64 bits, decimal
    operator TEXT NOT NULL, track TEXT NOT NULL, drive TEXT NOT NULL,
    started TEXT NOT NULL           -- UTC, ISO 8601
);
CREATE TABLE physical_pose (
    validation INTEGER NOT NULL REFERENCES physical_validation (number),
    place INTEGER NOT NULL,         -- in the plan, from 0
    pose INTEGER NOT NULL,          -- of the part's stable poses
    PRIMARY KEY (validation, place)
) WITHOUT ROWID;
CREATE TABLE physical_trial (
    validation INTEGER NOT NULL REFERENCES physical_validation (number),
    number INTEGER NOT NULL,        -- from 0
    pose INTEGER NOT NULL,
    outcome TEXT NOT NULL,          -- success, wrong-orientation, stuck, fell-off
    seconds REAL NOT NULL,          -- 0: not timed
    set_point REAL NOT NULL,        -- share of full
    frequency REAL NOT NULL,        -- Hz; 0: not known
    note TEXT NOT NULL,
    time TEXT NOT NULL,             -- UTC, ISO 8601
    PRIMARY KEY (validation, number)
) WITHOUT ROWID;
CREATE TABLE drive_log (
    id INTEGER PRIMARY KEY,         -- in the order in which it was logged
    number INTEGER NOT NULL,        -- within one connection, from 1
    time REAL NOT NULL,             -- s since 1970, UTC
    kind TEXT NOT NULL,
    set_point REAL, frequency REAL, enabled INTEGER,        -- share of full, Hz, 0 or 1
    acceleration REAL, half_stroke REAL, current REAL,      -- m/s^2, m, share of the rated one
    text TEXT NOT NULL
);
CREATE INDEX drive_log_time ON drive_log (time);
CREATE TABLE calibration (
    number INTEGER PRIMARY KEY,     -- from 0
    program TEXT NOT NULL,
    method TEXT NOT NULL,
    value REAL NOT NULL, low REAL NOT NULL, high REAL NOT NULL,     -- with the 95 % interval; SI
    frequency REAL NOT NULL,        -- Hz; 0: nothing vibrated
    operator TEXT NOT NULL, note TEXT NOT NULL,
    time TEXT NOT NULL              -- UTC, ISO 8601
);
CREATE TABLE calibration_reading (
    calibration INTEGER NOT NULL REFERENCES calibration (number),
    number INTEGER NOT NULL,        -- from 0
    first REAL NOT NULL, second REAL NOT NULL, third REAL NOT NULL, -- what they are is the method's; SI
    PRIMARY KEY (calibration, number)
) WITHOUT ROWID;
ALTER TABLE part ADD COLUMN symmetry_counts INTEGER NOT NULL DEFAULT 1;     -- 0 or 1
UPDATE study SET settings = json_set(settings, '$.part.symmetry', 'found');
)sql";

// Success while learning. NULL: not known.
constexpr const char* kVersion5 = R"sql(
ALTER TABLE individual ADD COLUMN oriented INTEGER;
ALTER TABLE generation ADD COLUMN top_success REAL;     -- mean share of the top 30 %
)sql";

// What moved the parts.
constexpr const char* kVersion6 = R"sql(
ALTER TABLE physical_trial ADD COLUMN feeder TEXT NOT NULL DEFAULT 'unknown';   -- or real, unconnected, virtual
ALTER TABLE physical_trial ADD COLUMN drive TEXT NOT NULL DEFAULT '';           -- title of its profile
ALTER TABLE physical_trial ADD COLUMN half_stroke REAL NOT NULL DEFAULT 0;      -- m; 0: not known
)sql";

// Drop tests, and which probabilities of the stable poses count.
constexpr const char* kVersion7 = R"sql(
CREATE TABLE drop_test (
    number INTEGER PRIMARY KEY,     -- from 0
    program TEXT NOT NULL,
    engine TEXT NOT NULL,
    drops INTEGER NOT NULL,
    height REAL NOT NULL,           -- m
    static_friction REAL NOT NULL, kinetic_friction REAL NOT NULL, restitution REAL NOT NULL,
    gravity REAL NOT NULL,          -- m/s^2
    seed TEXT NOT NULL,             -- unsigned 64 bits, decimal
    unsettled INTEGER NOT NULL,     -- drops that ended in no pose
    time TEXT NOT NULL              -- UTC, ISO 8601
);
CREATE TABLE drop_pose (
    test INTEGER NOT NULL REFERENCES drop_test (number),
    pose INTEGER NOT NULL,          -- of the part's stable poses when it was dropped
    count INTEGER NOT NULL,         -- drops that ended in it
    w REAL NOT NULL, x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
    PRIMARY KEY (test, pose)
) WITHOUT ROWID;
UPDATE study SET settings = json_set(settings, '$.part.poseWeights', 'quasi-static');
)sql";

// Any search, not the genetic one alone: designs instead of its genes, its strategy values as named numbers.
constexpr const char* kVersion8 = R"sql(
ALTER TABLE individual ADD COLUMN design BLOB NOT NULL DEFAULT x'';     -- numbers in [0, 1]
ALTER TABLE individual ADD COLUMN traits BLOB NOT NULL DEFAULT x'';     -- a double for each row of trait
CREATE TABLE trait (
    place INTEGER PRIMARY KEY,      -- from 0
    key TEXT NOT NULL               -- what the search calls it
);
CREATE TABLE curve (                -- what the search reports
    generation INTEGER NOT NULL REFERENCES generation (number),
    place INTEGER NOT NULL,         -- from 0
    key TEXT NOT NULL,
    value REAL NOT NULL,
    PRIMARY KEY (generation, place)
) WITHOUT ROWID;
CREATE TABLE search_state (         -- what the next generation follows from
    id INTEGER PRIMARY KEY CHECK (id = 1),
    generation INTEGER NOT NULL,    -- the last
    state BLOB NOT NULL             -- the search's own
);
INSERT INTO curve SELECT number, 0, 'p_x', top_crossover FROM generation;
INSERT INTO curve SELECT number, 1, 'p_dm', top_mutation FROM generation;
INSERT INTO curve SELECT number, 2, 'p_s', top_smoothing FROM generation;
UPDATE study SET settings = json_set(settings, '$.evolution.search', 'genetic', '$.track.traps', 'free-form');
)sql";

// Any objectives, not the paper's three alone. The best scores of a generation are its winner's.
constexpr const char* kVersion9 = R"sql(
CREATE TABLE objective (
    place INTEGER PRIMARY KEY,      -- from 0
    key TEXT NOT NULL UNIQUE        -- what the program calls it
);
INSERT INTO objective VALUES (0, 'F_C'), (1, 'F_D'), (2, 'F_O');
CREATE TABLE score (
    generation INTEGER NOT NULL, individual INTEGER NOT NULL,
    objective INTEGER NOT NULL REFERENCES objective (place),
    value REAL NOT NULL,
    error REAL NOT NULL,            -- standard error; 0: exact, or not known
    PRIMARY KEY (generation, individual, objective)
) WITHOUT ROWID;
CREATE TABLE top_score (            -- means of the top 30 %
    generation INTEGER NOT NULL REFERENCES generation (number),
    objective INTEGER NOT NULL REFERENCES objective (place),
    value REAL NOT NULL,
    PRIMARY KEY (generation, objective)
) WITHOUT ROWID;
CREATE TABLE selection_score (
    selection INTEGER NOT NULL, rank INTEGER NOT NULL,
    objective INTEGER NOT NULL REFERENCES objective (place),
    value REAL NOT NULL, error REAL NOT NULL,
    PRIMARY KEY (selection, rank, objective)
) WITHOUT ROWID;
CREATE TABLE check_score (
    generation INTEGER NOT NULL,
    engine INTEGER NOT NULL,        -- 0: that learned, 1: the reference
    objective INTEGER NOT NULL REFERENCES objective (place),
    value REAL NOT NULL, error REAL NOT NULL,
    PRIMARY KEY (generation, engine, objective)
) WITHOUT ROWID;
INSERT INTO score SELECT generation, number, 0, collision, 0 FROM individual
    UNION ALL SELECT generation, number, 1, distance, 0 FROM individual
    UNION ALL SELECT generation, number, 2, orientation, 0 FROM individual;
INSERT INTO top_score SELECT number, 0, top_collision FROM generation
    UNION ALL SELECT number, 1, top_distance FROM generation
    UNION ALL SELECT number, 2, top_orientation FROM generation;
INSERT INTO selection_score SELECT selection, rank, 0, collision, 0 FROM selection_entry
    UNION ALL SELECT selection, rank, 1, distance, 0 FROM selection_entry
    UNION ALL SELECT selection, rank, 2, orientation, 0 FROM selection_entry;
INSERT INTO check_score SELECT generation, 0, 0, learning_collision, 0 FROM winner_check
    UNION ALL SELECT generation, 0, 1, learning_distance, 0 FROM winner_check
    UNION ALL SELECT generation, 0, 2, learning_orientation, 0 FROM winner_check
    UNION ALL SELECT generation, 1, 0, reference_collision, 0 FROM winner_check
    UNION ALL SELECT generation, 1, 1, reference_distance, 0 FROM winner_check
    UNION ALL SELECT generation, 1, 2, reference_orientation, 0 FROM winner_check;
ALTER TABLE individual ADD COLUMN fitness REAL NOT NULL DEFAULT 0;          -- F, their sum
ALTER TABLE generation ADD COLUMN top_fitness REAL NOT NULL DEFAULT 0;
ALTER TABLE selection_entry ADD COLUMN fitness REAL NOT NULL DEFAULT 0;
ALTER TABLE winner_check ADD COLUMN learning_fitness REAL NOT NULL DEFAULT 0;
ALTER TABLE winner_check ADD COLUMN reference_fitness REAL NOT NULL DEFAULT 0;
UPDATE individual SET fitness = collision + distance + orientation;
UPDATE generation SET top_fitness = top_collision + top_distance + top_orientation;
UPDATE selection_entry SET fitness = collision + distance + orientation;
UPDATE winner_check SET learning_fitness = learning_collision + learning_distance + learning_orientation,
    reference_fitness = reference_collision + reference_distance + reference_orientation;
ALTER TABLE individual DROP COLUMN collision;
ALTER TABLE individual DROP COLUMN distance;
ALTER TABLE individual DROP COLUMN orientation;
ALTER TABLE generation DROP COLUMN best_collision;
ALTER TABLE generation DROP COLUMN best_distance;
ALTER TABLE generation DROP COLUMN best_orientation;
ALTER TABLE generation DROP COLUMN top_collision;
ALTER TABLE generation DROP COLUMN top_distance;
ALTER TABLE generation DROP COLUMN top_orientation;
ALTER TABLE selection_entry DROP COLUMN collision;
ALTER TABLE selection_entry DROP COLUMN distance;
ALTER TABLE selection_entry DROP COLUMN orientation;
ALTER TABLE winner_check DROP COLUMN learning_collision;
ALTER TABLE winner_check DROP COLUMN learning_distance;
ALTER TABLE winner_check DROP COLUMN learning_orientation;
ALTER TABLE winner_check DROP COLUMN reference_collision;
ALTER TABLE winner_check DROP COLUMN reference_distance;
ALTER TABLE winner_check DROP COLUMN reference_orientation;
UPDATE study SET settings = json_set(settings, '$.evolution.objectives', 'F_C, F_D, F_O');
)sql";

// The outcomes of trials. What was simulated before has none.
constexpr const char* kVersion10 = R"sql(
CREATE TABLE outcome_maker (
    number INTEGER PRIMARY KEY,     -- from 0
    program TEXT NOT NULL, engine TEXT NOT NULL, instruction_set TEXT NOT NULL
);
CREATE TABLE outcomes (             -- of the trials [first, first + count) of a run, all of one maker
    run TEXT NOT NULL,              -- generation, selection, validation
    number INTEGER NOT NULL,        -- of that
    first INTEGER NOT NULL,         -- through its individuals, ranks, poses, one after the other
    count INTEGER NOT NULL,
    maker INTEGER NOT NULL REFERENCES outcome_maker (number),
    trials BLOB NOT NULL,           -- packed (core/trial/outcome_codec.h)
    PRIMARY KEY (run, number, first)
);
)sql";

// As fine while learning as afterwards.
constexpr const char* kVersion11 = R"sql(
UPDATE study SET settings = json_set(settings, '$.evolution.learningStep_ms', 0.2);
)sql";

// The first generation at random.
constexpr const char* kVersion12 = R"sql(
UPDATE study SET settings = json_set(settings, '$.evolution.firstGeneration', 'random');
)sql";

// As many as a plan tried for a population.
constexpr const char* kVersion13 = R"sql(
UPDATE study SET settings = json_set(settings, '$.evolution.plannedTraps',
    max(32, 50 * json_extract(settings, '$.evolution.populationSize')));
)sql";

// One set of rates for an individual.
constexpr const char* kVersion14 = R"sql(
UPDATE study SET settings = json_set(settings, '$.evolution.strategyScope', 'individual');
)sql";

// Judged under one condition; the operating box is known to be what it was by default then.
constexpr const char* kVersion15 = R"sql(
ALTER TABLE selection ADD COLUMN box TEXT;   -- settings of the operating box as JSON; NULL: nominal
ALTER TABLE validation ADD COLUMN box TEXT;
UPDATE study SET settings = json_set(settings, '$.evolution.conditions', 'nominal',
    '$.validation.conditions', 'nominal');
)sql";

// What is wanted; nothing was.
constexpr const char* kVersion16 = R"sql(
ALTER TABLE selection_entry ADD COLUMN goal TEXT;   -- JSON; NULL: the one orientation
ALTER TABLE validation ADD COLUMN goal TEXT;
)sql";

// How robust tracks are.
constexpr const char* kVersion17 = R"sql(
CREATE TABLE robustness (           -- of an individual, the newest
    generation INTEGER NOT NULL, individual INTEGER NOT NULL,
    program TEXT NOT NULL, engine TEXT NOT NULL,
    box TEXT NOT NULL,              -- that it was measured in: settings of the operating box as JSON
    result TEXT NOT NULL,           -- JSON
    PRIMARY KEY (generation, individual)
);
)sql";

// Selected in corners of the box, too, and learned there; nothing was.
constexpr const char* kVersion18 = R"sql(
ALTER TABLE selection_entry ADD COLUMN corner_trials INTEGER NOT NULL DEFAULT 0;
ALTER TABLE selection_entry ADD COLUMN corner_oriented INTEGER NOT NULL DEFAULT 0;
UPDATE study SET settings = json_set(settings, '$.evolution.cornerShare', 0.0);
)sql";

// Generations of mended tracks; there were none.
constexpr const char* kVersion19 = R"sql(
ALTER TABLE generation ADD COLUMN mended_generation INTEGER;   -- what all of it is mended from; NULL: learned
ALTER TABLE generation ADD COLUMN mended_individual INTEGER;
)sql";

// Corners that are learned from a generation on; they were from the first.
constexpr const char* kVersion20 = R"sql(
UPDATE study SET settings = json_set(settings, '$.evolution.cornersFrom', 0);
)sql";

// Tracks of another study that the first generation can begin with; there were none.
constexpr const char* kVersion21 = R"sql(
CREATE TABLE known_track (
    number INTEGER PRIMARY KEY,     -- from 0, best first
    study TEXT NOT NULL,            -- name of its file
    design BLOB NOT NULL
);
CREATE TABLE known_trait (          -- what the search that found it knew of it
    number INTEGER NOT NULL, key TEXT NOT NULL, value REAL NOT NULL,
    PRIMARY KEY (number, key)
);
)sql";

// What streams of parts on tracks come to.
constexpr const char* kVersion22 = R"sql(
CREATE TABLE stream (               -- of an individual, the newest
    generation INTEGER NOT NULL, individual INTEGER NOT NULL,
    program TEXT NOT NULL, engine TEXT NOT NULL,
    box TEXT,                       -- that streams varied over, as JSON; NULL: all alike
    result TEXT NOT NULL,           -- JSON
    PRIMARY KEY (generation, individual)
);
)sql";

// Slope, a given trap, where parts that fall off come again: what sorting forgave fell anywhere.
constexpr const char* kVersion23 = R"sql(
UPDATE study SET settings = json_set(settings, '$.track.given', '', '$.track.slope_deg', 0,
    '$.track.returns', CASE WHEN json_extract(settings, '$.evolution.objectives') LIKE '%sorting%'
                       THEN 'anywhere' ELSE 'nowhere' END,
    '$.evolution.streamShare', 0.1, '$.evolution.streamsEach', 2);
)sql";

// Walls, and two objectives that are traded: none had them.
constexpr const char* kVersion24 = R"sql(
UPDATE study SET settings = json_set(settings, '$.track.innerWall_mm', 0, '$.track.outerWall_mm', 0,
    '$.evolution.tradeOff', '');
)sql";

// Spiral and chute: none had them.
constexpr const char* kVersion25 = R"sql(
UPDATE study SET settings = json_set(settings, '$.track.spiralWidth_mm', 0, '$.track.spiralWall_mm', 10,
    '$.track.spiralInclination_deg', 5, '$.track.chuteLength_mm', 0, '$.track.chuteAngle_deg', 20);
)sql";

constexpr std::array<Migration, 25> kMigrations = {
    {{1, kVersion1},   {2, kVersion2},   {3, kVersion3},   {4, kVersion4},
     {5, kVersion5},   {6, kVersion6},   {7, kVersion7},   {8, kVersion8, &turnGenesIntoDesigns},
     {9, kVersion9},   {10, kVersion10}, {11, kVersion11}, {12, kVersion12},
     {13, kVersion13}, {14, kVersion14}, {15, kVersion15}, {16, kVersion16},
     {17, kVersion17}, {18, kVersion18}, {19, kVersion19}, {20, kVersion20},
     {21, kVersion21}, {22, kVersion22}, {23, kVersion23}, {24, kVersion24},
     {25, kVersion25}}};

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
        if (migration.then != nullptr) migration.then(database);
        database.exec("PRAGMA user_version = " + std::to_string(migration.version));
    }
    transaction.commit();
}

}  // namespace trapwright::store
