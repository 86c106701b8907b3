#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>

#include <algorithm>
#include <iterator>

#include "core/store/packing.h"
#include "core/store/scores.h"
#include "core/store/study_state.h"

namespace trapwright::store {

namespace {

constexpr const char* kIndividualColumns =
    "design, traits, fitness, overlaps, trials, finished, fell_off, stuck, oriented";

/// What the traits of this study's individuals are called.
using TraitKeys = std::vector<std::string>;

TraitKeys readTraitKeys(SQLite::Database& database) {
    TraitKeys keys;
    SQLite::Statement query(database, "SELECT key FROM trait ORDER BY place");
    while (query.executeStep())
        keys.push_back(query.getColumn(0).getString());
    return keys;
}

void writeTraitKeys(SQLite::Database& database, const std::vector<search::NamedNumber>& traits) {
    database.exec("DELETE FROM trait");
    SQLite::Statement insert(database, "INSERT INTO trait VALUES (?, ?)");
    for (std::size_t i = 0; i < traits.size(); ++i) {
        insert.reset();
        SQLite::bind(insert, static_cast<int>(i), traits[i].key);
        insert.exec();
    }
}

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
    bindBlob(statement, 3, search::packDesign(record.design));
    std::vector<double> traits;
    for (const search::NamedNumber& trait : record.traits)
        traits.push_back(trait.value);
    bindBlob(statement, 4, packNumbers(traits));
    statement.bind(5, record.fitness.total);
    statement.bind(6, record.overlaps);
    statement.bind(7, record.trials);
    statement.bind(8, record.finished);
    statement.bind(9, record.fellOff);
    statement.bind(10, record.stuck);
    bindOptional(statement, 11, record.oriented);
    statement.exec();
}

/// Reads individuals from the columns of kIndividualColumns and the table of scores.
class IndividualReader {
 public:
    explicit IndividualReader(SQLite::Database& database)
        : traitKeys_(readTraitKeys(database)), scores_(database, kIndividualScores) {}

    /// From the columns from `first` on; none if a design is no design, or a count none.
    std::optional<study::IndividualRecord> read(const SQLite::Statement& query, int first, int generation,
                                                int number) {
        auto design = search::unpackDesign(readBlob(query, first));
        const auto traits = unpackNumbers(readBlob(query, first + 1));
        auto scores = scores_.read({generation, number});
        if (!design || !scores || !traits || traits->size() != traitKeys_.size()) return std::nullopt;
        study::IndividualRecord record;
        record.design = std::move(*design);
        for (std::size_t i = 0; i < traitKeys_.size(); ++i)
            record.traits.push_back({traitKeys_[i], (*traits)[i]});
        record.fitness = {query.getColumn(first + 2).getDouble(), std::move(*scores)};
        record.overlaps = query.getColumn(first + 3).getInt();
        record.trials = query.getColumn(first + 4).getInt();
        record.finished = query.getColumn(first + 5).getInt();
        record.fellOff = query.getColumn(first + 6).getInt();
        record.stuck = query.getColumn(first + 7).getInt();
        const auto oriented = query.getColumn(first + 8);
        if (!oriented.isNull()) record.oriented = oriented.getInt();
        const bool counted = areCounts(record.trials, {record.finished, record.fellOff, record.stuck});
        if (!counted || record.overlaps < 0 || !areCounts(record.trials, {record.oriented.value_or(0)}))
            return std::nullopt;
        return record;
    }

 private:
    TraitKeys traitKeys_;
    ScoreReader scores_;
};

constexpr const char* kSummaryQuery =
    "SELECT generation.number, winner, seconds, best.fitness, top_fitness, "
    "(SELECT sum(trials) FROM individual WHERE individual.generation = generation.number), best.oriented, "
    "best.trials, top_success, mended_generation, mended_individual "
    "FROM generation LEFT JOIN individual AS best "
    "ON best.generation = generation.number AND best.number = generation.winner ";

/// Reads summaries from rows of kSummaryQuery and the tables of scores.
class SummaryReader {
 public:
    SummaryReader(SQLite::Database& database, std::filesystem::path path)
        : path_(std::move(path)), best_(database, kIndividualScores), top_(database, kTopScores) {}

    base::Result<study::GenerationSummary> read(const SQLite::Statement& query) {
        study::GenerationSummary summary;
        summary.index = query.getColumn(0).getInt();
        summary.winner = query.getColumn(1).getInt();
        summary.seconds = query.getColumn(2).getDouble();
        auto best = best_.read({summary.index, summary.winner});
        auto top = top_.read({summary.index});
        if (!best || !top)
            return damagedValue(path_, "a score of generation " + std::to_string(summary.index));
        summary.statistics.best = {query.getColumn(3).getDouble(), std::move(*best)};
        summary.statistics.topMean = {query.getColumn(4).getDouble(), std::move(*top)};
        summary.trials = query.getColumn(5).getInt64();
        const auto oriented = query.getColumn(6);
        const int trials = query.getColumn(7).getInt();
        if (!oriented.isNull() && trials > 0) {
            if (!areCounts(trials, {oriented.getInt()}))
                return damagedValue(path_, "the winner of generation " + std::to_string(summary.index));
            summary.statistics.success = {oriented.getInt(), trials};
        }
        const auto topSuccess = query.getColumn(8);
        if (!topSuccess.isNull()) summary.statistics.topSuccess = topSuccess.getDouble();
        const auto mended = query.getColumn(9);
        if (!mended.isNull()) {
            summary.mendedFrom = {mended.getInt(), query.getColumn(10).getInt()};
            if (summary.mendedFrom->generation >= summary.index)
                return damagedValue(path_, "where generation " + std::to_string(summary.index) + " is from");
        }
        return summary;
    }

 private:
    std::filesystem::path path_;
    ScoreReader best_;
    ScoreReader top_;
};

/// Adds what the search reported of these generations; of all from the first of them on, whose numbers follow
/// each other.
void readCurves(SQLite::Database& database, std::vector<study::GenerationSummary>& summaries) {
    if (summaries.empty()) return;
    const int first = summaries.front().index;
    SQLite::Statement query(database,
                            "SELECT generation, key, value FROM curve WHERE generation BETWEEN ? AND ? "
                            "ORDER BY generation, place");
    SQLite::bind(query, first, summaries.back().index);
    while (query.executeStep()) {
        const auto at = static_cast<std::size_t>(query.getColumn(0).getInt() - first);
        if (at < summaries.size())
            summaries[at].statistics.curves.push_back(
                {query.getColumn(1).getString(), query.getColumn(2).getDouble()});
    }
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
    IndividualReader reader(database);
    std::vector<study::Individual> winners;
    while (query.executeStep()) {
        const int generation = query.getColumn(0).getInt();
        const int number = query.getColumn(1).getInt();
        auto record = reader.read(query, 2, generation, number);
        if (!record) return damagedValue(path, nameOf(generation, number));
        winners.push_back({{generation, number}, std::move(*record)});
    }
    return winners;
}

}  // namespace

void StudyFile::writeGeneration(const study::GenerationRecord& record) {
    SQLite::Database& database = *state_->database;
    SQLite::Statement generation(database,
                                 "INSERT INTO generation (number, program, winner, seconds, top_fitness, "
                                 "top_success, mended_generation, mended_individual) "
                                 "VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
    const study::GenerationStatistics& s = record.statistics;
    SQLite::bind(generation, record.index, state_->program, record.winner, record.seconds, s.topMean.total);
    bindOptional(generation, 6, s.topSuccess);
    const auto& from = record.mendedFrom;
    bindOptional(generation, 7, from ? std::optional(from->generation) : std::nullopt);
    bindOptional(generation, 8, from ? std::optional(from->individual) : std::nullopt);
    generation.exec();
    ScoreWriter(database, kTopScores).write({record.index}, s.topMean.scores);
    SQLite::Statement curve(database, "INSERT INTO curve VALUES (?, ?, ?, ?)");
    for (std::size_t i = 0; i < s.curves.size(); ++i) {
        curve.reset();
        SQLite::bind(curve, record.index, static_cast<int>(i), s.curves[i].key, s.curves[i].value);
        curve.exec();
    }
    if (record.index == 0 && !record.individuals.empty())
        writeTraitKeys(database, record.individuals.front().traits);
    SQLite::Statement individual(database, std::string("INSERT INTO individual (generation, number, ") +
                                               kIndividualColumns +
                                               ") VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    ScoreWriter scores(database, kIndividualScores);
    for (std::size_t i = 0; i < record.individuals.size(); ++i) {
        const int number = static_cast<int>(i);
        insertIndividual(individual, record.index, number, record.individuals[i]);
        scores.write({record.index, number}, record.individuals[i].fitness.scores);
    }
    SQLite::Statement state(database, "INSERT OR REPLACE INTO search_state VALUES (1, ?, ?)");
    state.bind(1, record.index);
    bindBlob(state, 2, record.searchState);
    state.exec();
    saveOutcomes(database, state_->program, OutcomeRun::generation, record.index, record.made);
}

base::Status StudyFile::saveGeneration(const study::GenerationRecord& record) {
    const std::string doing = "Generation " + std::to_string(record.index) + " could not be saved";
    return state_->save(doing, [&]() -> base::Status {
        SQLite::Transaction transaction(*state_->database, SQLite::TransactionBehavior::IMMEDIATE);
        const int count = state_->countRows("generation");
        if (record.index != count) {
            return base::Error{doing + ": the study " + path().string() + " has " + std::to_string(count) +
                               " generations, and the next one must have that number."};
        }
        writeGeneration(record);
        transaction.commit();
        return base::success();
    });
}

base::Result<TakenGenerations> StudyFile::takeGenerations(const StudyFile& from) {
    const auto refuse = [&](const std::string& why) {
        return base::Error{"What was learned in " + from.path().string() + " cannot be taken into " +
                           path().string() + ": " + why + "."};
    };
    const auto settings = loadSettings();
    const auto others = from.loadSettings();
    const auto part = loadPart();
    const auto otherPart = from.loadPart();
    for (const base::Error* error :
         {settings ? nullptr : &settings.error(), others ? nullptr : &others.error(),
          part ? nullptr : &part.error(), otherPart ? nullptr : &otherPart.error()})
        if (error != nullptr) return *error;
    const auto count = generationCount();
    if (!count) return count.error();
    const auto otherCount = from.generationCount();
    if (!otherCount) return otherCount.error();
    if (part->mesh.vertices != otherPart->mesh.vertices || part->mesh.triangles != otherPart->mesh.triangles)
        return refuse("its part is another one");
    if (!study::keepsScores(*settings, *others, std::max(*count, 1)))
        return refuse("it was learned with other settings");
    if (*count > 0 && *otherCount > 0) {
        // Of designs drawn at random: equal ones are the same.
        const int common = std::min(*count, *otherCount) - 1;
        const auto own = loadGeneration(common);
        if (!own) return own.error();
        const auto other = from.loadGeneration(common);
        if (!other) return other.error();
        if (own->individuals != other->individuals)
            return refuse("its generation " + std::to_string(common) + " is another one");
    }

    TakenGenerations taken;
    const auto load = [&](int index) -> base::Status {
        auto record = from.loadGeneration(index);
        if (!record) return record.error();
        for (std::size_t i = 0; i < record->individuals.size(); ++i) {
            const auto packed = from.loadLearningOutcomes({index, static_cast<int>(i)});
            if (!packed) return packed.error();
            if (!*packed) continue;
            auto outcomes = unpack(**packed);
            if (!outcomes) return outcomes.error();
            record->made.maker = (*packed)->maker;
            std::ranges::move(*outcomes, std::back_inserter(record->made.outcomes));
        }
        taken.generations.push_back(std::move(*record));
        return base::success();
    };
    // Learning goes on from the last one alone, so up to that whose state is there; another may come
    // meanwhile.
    for (int last = *otherCount; *count + static_cast<int>(taken.generations.size()) < last;) {
        while (*count + static_cast<int>(taken.generations.size()) < last)
            if (auto loaded = load(*count + static_cast<int>(taken.generations.size())); !loaded)
                return loaded.error();
        auto state = from.loadLearningState();
        if (!state) return state.error();
        if (!*state) return refuse("it has no state to go on from");
        last = (*state)->index + 1;
        taken.generations.back().searchState = std::move((*state)->search);
    }
    if (!taken.generations.empty()) {
        const auto saved = state_->save("The generations could not be saved", [&]() -> base::Status {
            SQLite::Transaction transaction(*state_->database, SQLite::TransactionBehavior::IMMEDIATE);
            for (const study::GenerationRecord& record : taken.generations)
                writeGeneration(record);
            transaction.commit();
            return base::success();
        });
        if (!saved) return saved.error();
    }
    const auto known = loadChecks();
    if (!known) return known.error();
    const auto checks = from.loadChecks();
    if (!checks) return checks.error();
    for (const study::CheckRecord& check : *checks) {
        const bool isKnown = std::ranges::any_of(
            *known, [&](const study::CheckRecord& one) { return one.generation == check.generation; });
        if (isKnown || check.generation >= *count + static_cast<int>(taken.generations.size())) continue;
        if (auto saved = saveCheck(check); !saved) return saved.error();
        taken.checks.push_back(check);
    }
    return taken;
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
        auto read = SummaryReader(*state_->database, path()).read(head);
        if (!read) return read.error();
        std::vector<study::GenerationSummary> one{std::move(*read)};
        readCurves(*state_->database, one);
        study::GenerationRecord record;
        record.index = one.front().index;
        record.winner = one.front().winner;
        record.statistics = std::move(one.front().statistics);
        record.seconds = one.front().seconds;
        record.mendedFrom = one.front().mendedFrom;

        IndividualReader reader(*state_->database);
        SQLite::Statement query(*state_->database,
                                std::string("SELECT ") + kIndividualColumns +
                                    " FROM individual WHERE generation = ? ORDER BY number");
        query.bind(1, index);
        while (query.executeStep()) {
            const int number = static_cast<int>(record.individuals.size());
            auto individual = reader.read(query, 0, index, number);
            if (!individual) return damagedValue(path(), nameOf(index, number));
            record.individuals.push_back(std::move(*individual));
        }
        const int count = static_cast<int>(record.individuals.size());
        if (record.winner < 0 || record.winner >= count)
            return damagedValue(path(), "the winner of generation " + std::to_string(index));
        return record;
    });
}

base::Result<study::IndividualRecord> StudyFile::loadIndividual(const study::IndividualId& id) const {
    const std::string name = nameOf(id.generation, id.individual);
    return guarded(
        path(), "The " + name + " could not be read", [&]() -> base::Result<study::IndividualRecord> {
            SQLite::Statement query(*state_->database,
                                    std::string("SELECT ") + kIndividualColumns +
                                        " FROM individual WHERE generation = ? AND number = ?");
            SQLite::bind(query, id.generation, id.individual);
            if (!query.executeStep()) {
                return base::Error{"The study " + path().string() + " has no " + name + "; it has " +
                                   std::to_string(state_->countRows("generation")) +
                                   " generations. Generations and individuals count from 0."};
            }
            auto record = IndividualReader(*state_->database).read(query, 0, id.generation, id.individual);
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
                       SummaryReader reader(*state_->database, path());
                       std::vector<study::GenerationSummary> summaries;
                       while (query.executeStep()) {
                           auto summary = reader.read(query);
                           if (!summary) return summary.error();
                           summaries.push_back(std::move(*summary));
                       }
                       readCurves(*state_->database, summaries);
                       return summaries;
                   });
}

base::Result<std::vector<study::ScorePair>> StudyFile::loadScorePairs(const std::string& first,
                                                                      const std::string& second) const {
    using Pairs = std::vector<study::ScorePair>;
    return guarded(path(), "The scores could not be read", [&]() -> base::Result<Pairs> {
        SQLite::Statement query(
            *state_->database,
            "SELECT individual.generation, individual.number, individual.trials, a.value, b.value "
            "FROM individual "
            "JOIN score a ON a.generation = individual.generation AND a.individual = individual.number "
            "AND a.objective = (SELECT place FROM objective WHERE key = ?) "
            "JOIN score b ON b.generation = individual.generation AND b.individual = individual.number "
            "AND b.objective = (SELECT place FROM objective WHERE key = ?) "
            "WHERE individual.trials > 0 ORDER BY individual.generation, individual.number");
        SQLite::bind(query, first, second);
        Pairs pairs;
        while (query.executeStep())
            pairs.push_back({{query.getColumn(0).getInt(), query.getColumn(1).getInt()},
                             query.getColumn(2).getInt(),
                             query.getColumn(3).getDouble(),
                             query.getColumn(4).getDouble()});
        return pairs;
    });
}

base::Result<std::optional<study::LearningState>> StudyFile::loadLearningState() const {
    using Last = std::optional<study::LearningState>;
    return guarded(path(), "The state of the search could not be read", [&]() -> base::Result<Last> {
        const int count = state_->countRows("generation");
        if (count == 0) return Last();
        SQLite::Statement query(*state_->database, "SELECT generation, state FROM search_state");
        if (!query.executeStep() || query.getColumn(0).getInt() != count - 1)
            return damagedValue(path(), "the state of the search");
        return Last({count - 1, readBlob(query, 1)});
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
