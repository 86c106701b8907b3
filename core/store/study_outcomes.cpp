#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/VariadicBind.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>

#include "core/store/study_state.h"
#include "core/trial/outcome_codec.h"

namespace trapwright::store {

namespace {

/// How a kind of run is called in the table of outcomes, and how many trials each of its members has.
struct RunKind {
    const char* name;
    const char* members;  // trials of those before ?2 in run ?1, and its own
};

RunKind kindOf(OutcomeRun run) {
    switch (run) {
        case OutcomeRun::generation:
            return {
                "generation",
                "SELECT (SELECT coalesce(sum(trials), 0) FROM individual WHERE generation = ?1 AND number "
                "< ?2), trials FROM individual WHERE generation = ?1 AND number = ?2"};
        case OutcomeRun::selection:
            return {"selection",
                    "SELECT (SELECT coalesce(sum(trials), 0) FROM selection_entry WHERE selection = ?1 AND "
                    "rank < ?2), trials FROM selection_entry WHERE selection = ?1 AND rank = ?2"};
        case OutcomeRun::validation:
            break;
    }
    return {
        "validation",
        "SELECT (SELECT coalesce(sum(trials), 0) FROM validation_row WHERE validation = ?1 AND pose < ?2), "
        "trials FROM validation_row WHERE validation = ?1 AND pose = ?2"};
}

int numberOf(SQLite::Database& database, const trial::OutcomeMaker& maker) {
    SQLite::Statement known(database,
                            "SELECT number FROM outcome_maker WHERE program = ? AND engine = ? AND "
                            "instruction_set = ?");
    SQLite::bind(known, maker.program, maker.engine, maker.instructionSet);
    if (known.executeStep()) return known.getColumn(0).getInt();
    const int number = database.execAndGet("SELECT count(*) FROM outcome_maker").getInt();
    SQLite::Statement add(database, "INSERT INTO outcome_maker VALUES (?, ?, ?, ?)");
    SQLite::bind(add, number, maker.program, maker.engine, maker.instructionSet);
    add.exec();
    return number;
}

base::Error damagedTrials(const std::filesystem::path& path) {
    return {"The study " + path.string() +
                " is damaged: the stored outcomes of these trials cannot be read. Scores and designs are not "
                "touched by that. Restore the study from a copy to see these trials.",
            base::ErrorKind::damaged};
}

/// The trials of one member of a run.
base::Result<std::optional<PackedOutcomes>> readOutcomes(SQLite::Database& database,
                                                         const std::filesystem::path& path, OutcomeRun run,
                                                         int number, int member) {
    const RunKind kind = kindOf(run);
    SQLite::Statement range(database, kind.members);
    SQLite::bind(range, number, member);
    std::optional<PackedOutcomes> packed;
    if (!range.executeStep()) return packed;
    const std::int64_t begin = range.getColumn(0).getInt64();
    const std::int64_t trials = range.getColumn(1).getInt();
    if (trials <= 0) return packed;
    constexpr std::int64_t kMostTrials = std::int64_t{1} << 53;  // far beyond what there can be
    if (begin < 0 || begin > kMostTrials) return damagedTrials(path);

    SQLite::Statement any(database, "SELECT 1 FROM outcomes WHERE run = ? AND number = ? LIMIT 1");
    SQLite::bind(any, kind.name, number);
    if (!any.executeStep()) return packed;

    SQLite::Statement query(
        database,
        "SELECT first, count, program, engine, instruction_set, trials FROM outcomes JOIN "
        "outcome_maker ON outcome_maker.number = maker WHERE run = ? AND outcomes.number = "
        "? AND first < ? AND first + count > ? ORDER BY first");
    SQLite::bind(query, kind.name, number, begin + trials, begin);
    std::int64_t reached = begin;
    while (query.executeStep()) {
        const std::int64_t first = query.getColumn(0).getInt64();
        const std::int64_t count = query.getColumn(1).getInt64();
        const bool follows = packed ? first == reached : first >= 0 && first <= reached;
        if (!follows || count <= 0 || count > static_cast<std::int64_t>(trial::kMostPacked))
            return damagedTrials(path);
        if (!packed) {
            packed.emplace();
            packed->maker = {query.getColumn(2).getString(), query.getColumn(3).getString(),
                             query.getColumn(4).getString()};
            packed->before = static_cast<std::size_t>(begin - first);
            packed->count = static_cast<std::size_t>(trials);
            packed->study = path;
        }
        packed->pieces.push_back({static_cast<std::size_t>(count), readBlob(query, 5)});
        reached = first + count;
    }
    if (reached < begin + trials) return damagedTrials(path);
    return packed;
}

}  // namespace

void saveOutcomes(SQLite::Database& database, const std::string& program, OutcomeRun run, int number,
                  const trial::MadeOutcomes& made) {
    if (made.outcomes.empty()) return;
    const int maker = numberOf(database, {program, made.maker.engine, made.maker.instructionSet});
    SQLite::Statement row(database, "INSERT INTO outcomes VALUES (?, ?, ?, ?, ?, ?)");
    std::span<const trial::Outcome> left(made.outcomes);
    for (std::int64_t first = 0; !left.empty();) {
        const std::size_t count = trial::countPackable(left);
        if (count == 0) throw std::length_error("a trial has more parts than a study can hold");
        const std::string bytes = trial::packOutcomes(left.first(count));
        row.reset();
        SQLite::bind(row, kindOf(run).name, number, first, static_cast<int>(count), maker);
        row.bindNoCopy(6, bytes.data(), static_cast<int>(bytes.size()));
        row.exec();
        left = left.subspan(count);
        first += static_cast<std::int64_t>(count);
    }
}

base::Result<std::vector<trial::Outcome>> unpack(const PackedOutcomes& packed) {
    std::vector<trial::Outcome> outcomes;
    std::size_t skipped = packed.before;
    for (const PackedOutcomes::Piece& piece : packed.pieces) {
        const auto some = trial::unpackOutcomes(piece.bytes, piece.count);
        if (!some || skipped > some->size()) return damagedTrials(packed.study);
        const std::size_t wanted = std::min(some->size() - skipped, packed.count - outcomes.size());
        const auto first = some->begin() + static_cast<std::ptrdiff_t>(skipped);
        outcomes.insert(outcomes.end(), first, first + static_cast<std::ptrdiff_t>(wanted));
        skipped = 0;
    }
    const auto isFinite = [](const trial::PartOutcome& part) {
        return part.farthest.position.allFinite() && part.farthest.rotation.coeffs().allFinite() &&
               std::isfinite(part.time);
    };
    const bool finite = std::ranges::all_of(outcomes, [&](const trial::Outcome& outcome) {
        return std::ranges::all_of(outcome.parts, isFinite);
    });
    if (outcomes.size() != packed.count || !finite) return damagedTrials(packed.study);
    return outcomes;
}

base::Result<std::optional<PackedOutcomes>> StudyFile::loadLearningOutcomes(
    const study::IndividualId& id) const {
    return guarded(path(), "The outcomes of trials could not be read", [&] {
        return readOutcomes(*state_->database, path(), OutcomeRun::generation, id.generation, id.individual);
    });
}

base::Result<std::optional<PackedOutcomes>> StudyFile::loadSelectionOutcomes(int selection, int entry) const {
    return guarded(path(), "The outcomes of trials could not be read", [&] {
        return readOutcomes(*state_->database, path(), OutcomeRun::selection, selection, entry);
    });
}

base::Result<std::optional<PackedOutcomes>> StudyFile::loadValidationOutcomes(int validation,
                                                                              int pose) const {
    return guarded(path(), "The outcomes of trials could not be read", [&] {
        return readOutcomes(*state_->database, path(), OutcomeRun::validation, validation, pose);
    });
}

}  // namespace trapwright::store
