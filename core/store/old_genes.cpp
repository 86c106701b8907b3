#include "core/store/old_genes.h"

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/VariadicBind.h>
#include <sqlite3.h>

#include <array>
#include <string>
#include <vector>

#include "core/search/ga/genetic_search.h"
#include "core/store/packing.h"
#include "core/store/study_state.h"
#include "core/study/track_design.h"

namespace trapwright::store {

namespace {

namespace ga = search::ga;

constexpr int kGeneBits = 10;

struct OldIndividual {
    int number = 0;
    ga::Chromosome genes;
    double score = 0.0;
};

[[noreturn]] void throwDamaged(const std::string& what) {
    throw SQLite::Exception(what, SQLITE_CORRUPT);
}

ga::Bits readGene(const SQLite::Statement& query, int column, int bitsPerValue) {
    auto gene = ga::unpackBits(readBlob(query, column));
    if (!gene || gene->size() % static_cast<std::size_t>(bitsPerValue) != 0)
        throwDamaged("the genes of an individual are none");
    return std::move(*gene);
}

std::vector<OldIndividual> readIndividuals(SQLite::Database& database, int generation) {
    SQLite::Statement query(database,
                            "SELECT number, points, lengths, strategy, collision, distance, orientation "
                            "FROM individual WHERE generation = ? ORDER BY number");
    query.bind(1, generation);
    std::vector<OldIndividual> individuals;
    while (query.executeStep()) {
        OldIndividual individual;
        individual.number = query.getColumn(0).getInt();
        individual.genes = {readGene(query, 1, kGeneBits), readGene(query, 2, kGeneBits),
                            readGene(query, 3, ga::kStrategyBits)};
        if (individual.genes.strategy.size() != std::size_t{3} * ga::kStrategyBits)
            throwDamaged("the strategy values of an individual are none");
        individual.score =
            query.getColumn(4).getDouble() + query.getColumn(5).getDouble() + query.getColumn(6).getDouble();
        individuals.push_back(std::move(individual));
    }
    return individuals;
}

/// The settings that the genes were bred with.
ga::TransitionParameters readParameters(SQLite::Database& database) {
    const std::string text = database.execAndGet("SELECT settings FROM study").getString();
    const auto settings = study::settingsFromJson(text, study::Settings());
    if (!settings) throwDamaged(settings.error().message);
    return study::searchParameters(settings->evolution).genetic.transition;
}

void writeDesign(SQLite::Statement& update, int generation, const OldIndividual& individual,
                 const ga::TransitionParameters& parameters) {
    search::Design design = ga::decodeGray(individual.genes.points, kGeneBits);
    const std::vector<double> lengths = ga::decodeGray(individual.genes.singles, kGeneBits);
    design.insert(design.end(), lengths.begin(), lengths.end());
    const ga::StrategyValues strategy =
        ga::limitStrategy(ga::decodeStrategy(individual.genes.strategy), parameters);
    const std::string packed = search::packDesign(design);
    const std::string traits =
        packNumbers(std::array{strategy.points.crossover, strategy.points.mutation, strategy.smoothing});
    update.reset();
    update.bind(1, packed.data(), static_cast<int>(packed.size()));
    update.bind(2, traits.data(), static_cast<int>(traits.size()));
    update.bind(3, generation);
    update.bind(4, individual.number);
    update.exec();
}

void writeState(SQLite::Database& database, int generation, const std::vector<OldIndividual>& individuals) {
    std::vector<ga::Chromosome> population;
    std::vector<double> scores;
    for (const OldIndividual& individual : individuals) {
        population.push_back(individual.genes);
        scores.push_back(individual.score);
    }
    const std::string state = ga::packState(static_cast<std::uint32_t>(generation + 1), population, scores);
    SQLite::Statement insert(database, "INSERT INTO search_state VALUES (1, ?, ?)");
    insert.bind(1, generation);
    insert.bind(2, state.data(), static_cast<int>(state.size()));
    insert.exec();
}

}  // namespace

void turnGenesIntoDesigns(SQLite::Database& database) {
    const int generations = database.execAndGet("SELECT count(*) FROM generation").getInt();
    if (generations > 0) {
        const ga::TransitionParameters parameters = readParameters(database);
        database.exec("INSERT INTO trait VALUES (0, 'p_x'), (1, 'p_dm'), (2, 'p_s')");
        SQLite::Statement update(
            database, "UPDATE individual SET design = ?, traits = ? WHERE generation = ? AND number = ?");
        for (int generation = 0; generation < generations; ++generation) {
            const std::vector<OldIndividual> individuals = readIndividuals(database, generation);
            for (const OldIndividual& individual : individuals)
                writeDesign(update, generation, individual, parameters);
            if (generation == generations - 1) writeState(database, generation, individuals);
        }
    }
    database.exec(
        "ALTER TABLE individual DROP COLUMN points; ALTER TABLE individual DROP COLUMN lengths; "
        "ALTER TABLE individual DROP COLUMN strategy; ALTER TABLE generation DROP COLUMN top_crossover; "
        "ALTER TABLE generation DROP COLUMN top_mutation; ALTER TABLE generation DROP COLUMN top_smoothing;");
}

}  // namespace trapwright::store
