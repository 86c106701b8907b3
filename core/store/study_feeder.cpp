#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <SQLiteCpp/VariadicBind.h>

#include <array>

#include "core/store/study_state.h"

namespace trapwright::store {

namespace {

constexpr std::size_t kReadingColumns = 3;  // numbers of a reading; what a method has not is 0

void bindOptional(SQLite::Statement& row, int column, const std::optional<double>& value) {
    if (value) {
        row.bind(column, *value);
    } else {
        row.bind(column);  // NULL
    }
}

std::optional<double> readOptional(const SQLite::Statement& query, int column) {
    if (query.isColumnNull(column)) return std::nullopt;
    return query.getColumn(column).getDouble();
}

void bindEntry(SQLite::Statement& row, const drive::LogEntry& entry) {
    row.bind(1, entry.number);
    row.bind(2, entry.time);
    row.bind(3, std::string(drive::nameOf(entry.kind)));
    bindOptional(row, 4, entry.setPoint);
    bindOptional(row, 5, entry.frequency);
    if (entry.enabled) {
        row.bind(6, *entry.enabled ? 1 : 0);
    } else {
        row.bind(6);
    }
    bindOptional(row, 7, entry.acceleration);
    bindOptional(row, 8, entry.halfStroke);
    bindOptional(row, 9, entry.current);
    row.bind(10, entry.text);
}

base::Result<drive::LogEntry> readEntry(const std::filesystem::path& path, const SQLite::Statement& query) {
    drive::LogEntry entry;
    entry.number = query.getColumn(0).getInt64();
    entry.time = query.getColumn(1).getDouble();
    const auto kind = drive::findLogKind(query.getColumn(2).getString());
    if (!kind) return damagedValue(path, "a line of the drive's log");
    entry.kind = *kind;
    entry.setPoint = readOptional(query, 3);
    entry.frequency = readOptional(query, 4);
    if (!query.isColumnNull(5)) entry.enabled = query.getColumn(5).getInt() != 0;
    entry.acceleration = readOptional(query, 6);
    entry.halfStroke = readOptional(query, 7);
    entry.current = readOptional(query, 8);
    entry.text = query.getColumn(9).getString();
    return entry;
}

base::Result<calibration::Calibration> readCalibration(const std::filesystem::path& path,
                                                       const SQLite::Statement& query) {
    calibration::Calibration calibration;
    calibration.number = query.getColumn(0).getInt();
    const auto method = calibration::methodOf(query.getColumn(1).getString());
    if (!method) return damagedValue(path, "the method of a measurement");
    calibration.method = *method;
    calibration.readings = calibration::emptyReadings(*method);
    calibration.result = {query.getColumn(2).getDouble(), query.getColumn(3).getDouble(),
                          query.getColumn(4).getDouble()};
    calibration.frequency = query.getColumn(5).getDouble();
    calibration.operatorName = query.getColumn(6).getString();
    calibration.note = query.getColumn(7).getString();
    calibration.time = query.getColumn(8).getString();
    return calibration;
}

}  // namespace

base::Status StudyFile::appendDriveLog(std::span<const drive::LogEntry> entries) {
    return state_->save("The drive's log could not be saved", [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        SQLite::Statement row(database,
                              "INSERT INTO drive_log (number, time, kind, set_point, frequency, enabled, "
                              "acceleration, half_stroke, current, text) "
                              "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        for (const drive::LogEntry& entry : entries) {
            row.reset();
            bindEntry(row, entry);
            row.exec();
        }
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<drive::LogEntry>> StudyFile::loadDriveLog(double from, double to) const {
    return guarded(
        path(), "The drive's log could not be read", [&]() -> base::Result<std::vector<drive::LogEntry>> {
            SQLite::Statement query(*state_->database,
                                    "SELECT number, time, kind, set_point, frequency, enabled, acceleration, "
                                    "half_stroke, current, text FROM drive_log WHERE time >= ? AND time < ? "
                                    "ORDER BY id");
            query.bind(1, from);
            query.bind(2, to);
            std::vector<drive::LogEntry> entries;
            while (query.executeStep()) {
                auto entry = readEntry(path(), query);
                if (!entry) return entry.error();
                entries.push_back(std::move(*entry));
            }
            return entries;
        });
}

base::Status StudyFile::addCalibration(const calibration::Calibration& calibration) {
    return state_->save("The measurement could not be saved", [&]() -> base::Status {
        SQLite::Database& database = *state_->database;
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        const int number = state_->countRows("calibration");
        SQLite::Statement head(database, "INSERT INTO calibration VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
        SQLite::bind(head, number, state_->program, calibration::nameOf(calibration.method),
                     calibration.result.value, calibration.result.low, calibration.result.high,
                     calibration.frequency, calibration.operatorName, calibration.note, calibration.time);
        head.exec();
        SQLite::Statement row(database, "INSERT INTO calibration_reading VALUES (?, ?, ?, ?, ?)");
        int place = 0;
        for (std::vector<double>& numbers : calibration::numbersOf(calibration.readings)) {
            numbers.resize(kReadingColumns, 0.0);
            row.reset();
            SQLite::bind(row, number, place++, numbers[0], numbers[1], numbers[2]);
            row.exec();
        }
        transaction.commit();
        return base::success();
    });
}

base::Result<std::vector<calibration::Calibration>> StudyFile::loadCalibrations() const {
    return guarded(path(), "The measurements could not be read",
                   [&]() -> base::Result<std::vector<calibration::Calibration>> {
                       SQLite::Statement heads(
                           *state_->database,
                           "SELECT number, method, value, low, high, frequency, operator, note, time "
                           "FROM calibration ORDER BY number");
                       SQLite::Statement rows(*state_->database,
                                              "SELECT first, second, third FROM calibration_reading "
                                              "WHERE calibration = ? ORDER BY number");
                       std::vector<calibration::Calibration> calibrations;
                       while (heads.executeStep()) {
                           auto calibration = readCalibration(path(), heads);
                           if (!calibration) return calibration.error();
                           rows.reset();
                           rows.bind(1, calibration->number);
                           while (rows.executeStep()) {
                               const std::array numbers{rows.getColumn(0).getDouble(),
                                                        rows.getColumn(1).getDouble(),
                                                        rows.getColumn(2).getDouble()};
                               calibration::addReading(calibration->readings, numbers);
                           }
                           calibrations.push_back(std::move(*calibration));
                       }
                       return calibrations;
                   });
}

}  // namespace trapwright::store
