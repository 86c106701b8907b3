#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>

#include <charconv>

#include "core/store/study_state.h"

namespace trapwright::store {

namespace {

constexpr int kMostPoses = 10'000;  // more than any part has

const std::string kNotSaved = "The trial on the feeder could not be saved";

int countTrials(SQLite::Database& database, int validation) {
    SQLite::Statement query(database, "SELECT count(*) FROM physical_trial WHERE validation = ?");
    query.bind(1, validation);
    query.executeStep();
    return query.getColumn(0).getInt();
}

bool hasValidation(SQLite::Database& database, int validation) {
    SQLite::Statement query(database, "SELECT 1 FROM physical_validation WHERE number = ?");
    query.bind(1, validation);
    return query.executeStep();
}

void insertTrial(SQLite::Database& database, int validation, const study::PhysicalTrial& trial) {
    SQLite::Statement row(database, "INSERT INTO physical_trial VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    SQLite::bind(row, validation, trial.number, trial.pose, std::string(trial::verdictName(trial.outcome)),
                 trial.seconds, trial.setPoint, trial.frequency, trial.note, trial.time,
                 study::nameOf(trial.feeder), trial.drive, trial.halfStroke);
    row.exec();
}

base::Result<study::PhysicalValidation> readHead(const std::filesystem::path& path,
                                                 const SQLite::Statement& query) {
    study::PhysicalValidation validation;
    validation.number = query.getColumn(0).getInt();
    validation.program = query.getColumn(1).getString();
    validation.generation = query.getColumn(2).getInt();
    validation.individual = query.getColumn(3).getInt();
    validation.plan.repetitions = query.getColumn(4).getInt();
    validation.plan.shuffled = query.getColumn(5).getInt() != 0;
    // Past what any window offers, and few enough for the order of all trials to be drawn up.
    constexpr int kMostRepetitions = 100'000;
    if (!areCounts(kMostRepetitions, {validation.plan.repetitions}))
        return damagedValue(path, "the number of repetitions of a physical validation");
    const std::string seed = query.getColumn(6).getString();
    const auto [end, problem] = std::from_chars(seed.data(), seed.data() + seed.size(), validation.plan.seed);
    if (problem != std::errc() || end != seed.data() + seed.size())
        return damagedValue(path, "the seed of a physical validation");
    validation.operatorName = query.getColumn(7).getString();
    validation.track = query.getColumn(8).getString();
    validation.drive = query.getColumn(9).getString();
    validation.started = query.getColumn(10).getString();
    return validation;
}

base::Result<study::PhysicalTrial> readTrial(const std::filesystem::path& path,
                                             const SQLite::Statement& query) {
    study::PhysicalTrial trial;
    trial.number = query.getColumn(0).getInt();
    trial.pose = query.getColumn(1).getInt();
    if (!areCounts(kMostPoses, {trial.pose})) return damagedValue(path, "the pose of a trial on the feeder");
    const auto outcome = trial::findVerdict(query.getColumn(2).getString());
    if (!outcome) return damagedValue(path, "the outcome of a trial on the feeder");
    trial.outcome = *outcome;
    trial.seconds = query.getColumn(3).getDouble();
    trial.setPoint = query.getColumn(4).getDouble();
    trial.frequency = query.getColumn(5).getDouble();
    trial.note = query.getColumn(6).getString();
    trial.time = query.getColumn(7).getString();
    const auto feeder = study::feederKindOf(query.getColumn(8).getString());
    if (!feeder) return damagedValue(path, "the feeder of a trial");
    trial.feeder = *feeder;
    trial.drive = query.getColumn(9).getString();
    trial.halfStroke = query.getColumn(10).getDouble();
    return trial;
}

}  // namespace

base::Status StudyFile::chooseWinner(const std::optional<study::IndividualId>& winner) {
    return state_->save("The choice of the final track could not be saved", [&]() -> base::Status {
        if (!winner) {
            state_->database->exec("DELETE FROM chosen_winner");
            return base::success();
        }
        SQLite::Statement row(*state_->database, "INSERT OR REPLACE INTO chosen_winner VALUES (1, ?, ?)");
        SQLite::bind(row, winner->generation, winner->individual);
        row.exec();
        return base::success();
    });
}

base::Result<std::optional<study::IndividualId>> StudyFile::loadChosenWinner() const {
    return guarded(path(), "The choice of the final track could not be read",
                   [&]() -> base::Result<std::optional<study::IndividualId>> {
                       SQLite::Statement query(*state_->database,
                                               "SELECT generation, individual FROM chosen_winner");
                       if (!query.executeStep()) return std::optional<study::IndividualId>();
                       return std::optional(
                           study::IndividualId{query.getColumn(0).getInt(), query.getColumn(1).getInt()});
                   });
}

base::Status StudyFile::addPhysicalValidation(const study::PhysicalValidation& validation) {
    return state_->save("The physical validation could not be saved", [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        const int number = state_->countRows("physical_validation");
        const study::PhysicalPlan& plan = validation.plan;
        SQLite::Statement head(database,
                               "INSERT INTO physical_validation VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        SQLite::bind(head, number, state_->program, validation.generation, validation.individual,
                     plan.repetitions, plan.shuffled ? 1 : 0, std::to_string(plan.seed),
                     validation.operatorName, validation.track, validation.drive, validation.started);
        head.exec();
        SQLite::Statement row(database, "INSERT INTO physical_pose VALUES (?, ?, ?)");
        int place = 0;
        for (const int pose : plan.poses) {
            row.reset();
            SQLite::bind(row, number, place++, pose);
            row.exec();
        }
        for (const study::PhysicalTrial& trial : validation.trials)
            insertTrial(database, number, trial);
        transaction.commit();
        return base::success();
    });
}

base::Status StudyFile::addPhysicalTrial(int validation, const study::PhysicalTrial& trial) {
    return state_->save(kNotSaved, [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        if (!hasValidation(database, validation)) {
            return base::Error{kNotSaved + ": the study " + path().string() + " has no validation " +
                               std::to_string(validation + 1) + "."};
        }
        if (const int next = countTrials(database, validation); next != trial.number) {
            return base::Error{kNotSaved + ": it is trial " + std::to_string(trial.number + 1) +
                               ", but the next one in the study " + path().string() + " is " +
                               std::to_string(next + 1) + "."};
        }
        insertTrial(database, validation, trial);
        transaction.commit();
        return base::success();
    });
}

base::Status StudyFile::removeLastPhysicalTrial(int validation) {
    const std::string doing = "The last trial on the feeder could not be taken back";
    return state_->save(doing, [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        const int trials = countTrials(database, validation);
        if (trials == 0)
            return base::Error{doing + ": the study " + path().string() + " has none of this validation."};
        SQLite::Statement remove(database, "DELETE FROM physical_trial WHERE validation = ? AND number = ?");
        SQLite::bind(remove, validation, trials - 1);
        remove.exec();
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<study::PhysicalValidation>> StudyFile::loadPhysicalValidations() const {
    return guarded(
        path(), "The physical validations could not be read",
        [&]() -> base::Result<std::vector<study::PhysicalValidation>> {
            SQLite::Statement heads(*state_->database,
                                    "SELECT number, program, generation, individual, repetitions, shuffled, "
                                    "seed, operator, track, drive, started "
                                    "FROM physical_validation ORDER BY number");
            SQLite::Statement poses(*state_->database,
                                    "SELECT pose FROM physical_pose WHERE validation = ? ORDER BY place");
            SQLite::Statement trials(
                *state_->database,
                "SELECT number, pose, outcome, seconds, set_point, frequency, note, time, feeder, drive, "
                "half_stroke "
                "FROM physical_trial WHERE validation = ? ORDER BY number");
            std::vector<study::PhysicalValidation> validations;
            while (heads.executeStep()) {
                auto validation = readHead(path(), heads);
                if (!validation) return validation.error();
                poses.reset();
                poses.bind(1, validation->number);
                while (poses.executeStep()) {
                    validation->plan.poses.push_back(poses.getColumn(0).getInt());
                    if (!areCounts(kMostPoses, {validation->plan.poses.back()}))
                        return damagedValue(path(), "a pose of a physical validation");
                }
                if (validation->plan.poses.size() > static_cast<std::size_t>(kMostPoses))
                    return damagedValue(path(), "the poses of a physical validation");
                trials.reset();
                trials.bind(1, validation->number);
                while (trials.executeStep()) {
                    auto trial = readTrial(path(), trials);
                    if (!trial) return trial.error();
                    validation->trials.push_back(std::move(*trial));
                }
                validations.push_back(std::move(*validation));
            }
            return validations;
        });
}

}  // namespace trapwright::store
