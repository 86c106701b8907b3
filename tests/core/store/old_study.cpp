#include "tests/core/store/old_study.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/search/ga/genes.h"
#include "core/store/packing.h"

namespace trapwright::sample {

namespace {

/// The paper's three scores as columns.
void dropVersion9(SQLite::Database& database) {
    struct Owner {
        std::string table;
        std::string prefix;  // of the columns
        std::string scores;  // where they are now
        std::string condition;
    };
    const std::vector<Owner> owners = {
        {"individual", "", "score", "score.generation = individual.generation AND individual = number"},
        {"generation", "best_", "score", "generation = generation.number AND individual = winner"},
        {"generation", "top_", "top_score", "generation = generation.number"},
        {"selection_entry", "", "selection_score",
         "selection_score.selection = selection_entry.selection AND selection_score.rank = "
         "selection_entry.rank"},
        {"winner_check", "learning_", "check_score",
         "check_score.generation = winner_check.generation AND engine = 0"},
        {"winner_check", "reference_", "check_score",
         "check_score.generation = winner_check.generation AND engine = 1"}};
    for (const Owner& owner : owners) {
        int place = 0;
        for (const char* name : {"collision", "distance", "orientation"}) {
            const std::string column = owner.prefix + name;
            database.exec("ALTER TABLE " + owner.table + " ADD COLUMN " + column +
                          " REAL NOT NULL DEFAULT 0");
            database.exec("UPDATE " + owner.table + " SET " + column + " = (SELECT value FROM " +
                          owner.scores + " WHERE " + owner.condition +
                          " AND objective = " + std::to_string(place++) + ")");
        }
    }
    database.exec(
        "ALTER TABLE individual DROP COLUMN fitness; ALTER TABLE generation DROP COLUMN top_fitness; "
        "ALTER TABLE selection_entry DROP COLUMN fitness; ALTER TABLE winner_check DROP COLUMN "
        "learning_fitness; ALTER TABLE winner_check DROP COLUMN reference_fitness; DROP TABLE score; "
        "DROP TABLE top_score; DROP TABLE selection_score; DROP TABLE check_score; DROP TABLE objective; "
        "UPDATE study SET settings = json_remove(settings, '$.evolution.objectives')");
}

/// Genes instead of designs: 80 numbers of points and 5 lengths of 10 bits, three strategy values of 20.
void dropVersion8(SQLite::Database& database) {
    namespace ga = search::ga;
    database.exec(
        "ALTER TABLE individual ADD COLUMN points BLOB NOT NULL DEFAULT x''; "
        "ALTER TABLE individual ADD COLUMN lengths BLOB NOT NULL DEFAULT x''; "
        "ALTER TABLE individual ADD COLUMN strategy BLOB NOT NULL DEFAULT x'';");
    for (const char* name : {"crossover", "mutation", "smoothing"})
        database.exec(std::string("ALTER TABLE generation ADD COLUMN top_") + name +
                      " REAL NOT NULL DEFAULT 0");
    database.exec(
        "UPDATE generation SET top_crossover = (SELECT value FROM curve WHERE generation = number AND key = "
        "'p_x'), "
        "top_mutation = (SELECT value FROM curve WHERE generation = number AND key = 'p_dm'), "
        "top_smoothing = (SELECT value FROM curve WHERE generation = number AND key = 'p_s')");
    SQLite::Statement query(database, "SELECT generation, number, design, traits FROM individual");
    struct Row {
        int generation;
        int number;
        std::string points, lengths, strategy;
    };
    std::vector<Row> rows;
    while (query.executeStep()) {
        const auto design = search::unpackDesign(query.getColumn(2).getString()).value();
        const auto traits = store::unpackNumbers(query.getColumn(3).getString()).value();
        const std::span<const double> numbers(design);
        rows.push_back({query.getColumn(0).getInt(), query.getColumn(1).getInt(),
                        ga::packBits(ga::encodeGray(numbers.first(80), 10)),
                        ga::packBits(ga::encodeGray(numbers.subspan(80), 10)),
                        ga::packBits(ga::encodeGray(std::array{traits[0], traits[1], traits[2] / 0.3},
                                                    ga::kStrategyBits))});
    }
    SQLite::Statement update(
        database,
        "UPDATE individual SET points = ?, lengths = ?, strategy = ? WHERE generation = ? AND number = ?");
    for (const Row& row : rows) {
        update.reset();
        int column = 0;
        for (const std::string* blob : {&row.points, &row.lengths, &row.strategy})
            update.bind(++column, blob->data(), static_cast<int>(blob->size()));
        update.bind(4, row.generation);
        update.bind(5, row.number);
        update.exec();
    }
    database.exec(
        "ALTER TABLE individual DROP COLUMN design; ALTER TABLE individual DROP COLUMN traits; "
        "DROP TABLE curve; DROP TABLE trait; DROP TABLE search_state; "
        "UPDATE study SET settings = json_remove(settings, '$.evolution.search')");
}

}  // namespace

void makeOld(const std::filesystem::path& path, int version) {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
    if (version < 22) database.exec("DROP TABLE stream");
    if (version < 21) database.exec("DROP TABLE known_track; DROP TABLE known_trait");
    if (version < 20)
        database.exec("UPDATE study SET settings = json_remove(settings, '$.evolution.cornersFrom')");
    if (version < 19)
        database.exec(
            "ALTER TABLE generation DROP COLUMN mended_generation; "
            "ALTER TABLE generation DROP COLUMN mended_individual");
    if (version < 18)
        database.exec(
            "ALTER TABLE selection_entry DROP COLUMN corner_trials; "
            "ALTER TABLE selection_entry DROP COLUMN corner_oriented; "
            "UPDATE study SET settings = json_remove(settings, '$.evolution.cornerShare', "
            "'$.validation.selectionCornerTrials')");
    if (version < 17) database.exec("DROP TABLE robustness");
    if (version < 16)
        database.exec(
            "ALTER TABLE selection_entry DROP COLUMN goal; ALTER TABLE validation DROP COLUMN goal; "
            "UPDATE study SET settings = json_remove(settings, '$.target')");
    if (version < 15)
        database.exec(
            "ALTER TABLE selection DROP COLUMN box; ALTER TABLE validation DROP COLUMN box; "
            "UPDATE study SET settings = json_remove(settings, '$.evolution.conditions', "
            "'$.validation.conditions', '$.box')");
    if (version < 14)
        database.exec("UPDATE study SET settings = json_remove(settings, '$.evolution.strategyScope')");
    if (version < 13)
        database.exec("UPDATE study SET settings = json_remove(settings, '$.evolution.plannedTraps')");
    if (version < 12)
        database.exec("UPDATE study SET settings = json_remove(settings, '$.evolution.firstGeneration')");
    if (version < 11)
        database.exec("UPDATE study SET settings = json_remove(settings, '$.evolution.learningStep_ms')");
    if (version < 10) database.exec("DROP TABLE outcomes; DROP TABLE outcome_maker");
    if (version < 9) dropVersion9(database);
    if (version < 8) dropVersion8(database);
    if (version < 7) database.exec("DROP TABLE drop_pose; DROP TABLE drop_test;");
    if (version < 6) {
        database.exec(
            "ALTER TABLE physical_trial DROP COLUMN feeder; ALTER TABLE physical_trial DROP COLUMN drive; "
            "ALTER TABLE physical_trial DROP COLUMN half_stroke;");
    }
    if (version < 5)
        database.exec(
            "ALTER TABLE individual DROP COLUMN oriented; ALTER TABLE generation DROP COLUMN top_success;");
    if (version < 4) {
        database.exec(
            "DROP TABLE calibration_reading; DROP TABLE calibration; DROP TABLE drive_log; "
            "DROP TABLE physical_trial; DROP TABLE physical_pose; DROP TABLE physical_validation; "
            "DROP TABLE chosen_winner; ALTER TABLE part DROP COLUMN symmetry_counts;");
    }
    if (version < 3)
        database.exec("UPDATE study SET settings = json_remove(settings, '$.evolution.learningStuckTime_s')");
    if (version < 2) {
        database.exec(
            "DROP TABLE winner_check; UPDATE study SET settings = json_remove(settings, "
            "'$.evolution.racingTrials', '$.evolution.racingShare', '$.evolution.commonRandomNumbers')");
    }
    database.exec("PRAGMA user_version = " + std::to_string(version));
}

}  // namespace trapwright::sample
