#include <SQLiteCpp/SQLiteCpp.h>
#include <fuzzer/FuzzedDataProvider.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/part/shapes.h"
#include "core/store/study_file.h"
#include "core/study/presets.h"
#include "tests/fuzz/read_study.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

namespace {

struct Column {
    std::string table;
    std::string name;
};

std::vector<std::string> listTables(SQLite::Database& database) {
    std::vector<std::string> tables;
    SQLite::Statement query(database, "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name");
    while (query.executeStep())
        tables.push_back(query.getColumn(0).getString());
    return tables;
}

/// A row of plain values for a table that has none.
void addRow(SQLite::Database& database, const std::string& table) {
    if (database.execAndGet("SELECT count(*) FROM " + table).getInt() > 0) return;
    SQLite::Statement query(database, "SELECT type, name FROM pragma_table_info(?)");
    query.bind(1, table);
    std::string values;
    while (query.executeStep()) {
        const std::string type = query.getColumn(0).getString();
        const std::string name = query.getColumn(1).getString();
        const bool isKey = name == "id";
        // A design of eight numbers, and one trait.
        const char* blob = name == "traits" ? "x'000000000000e03f'" : "x'0800000001ff'";
        values += values.empty() ? "" : ", ";
        if (type == "INTEGER") {
            values += isKey ? "1" : "0";
        } else {
            values += type == "REAL" ? "0.5" : type == "BLOB" ? blob : "'1'";
        }
    }
    database.exec("INSERT INTO " + table + " VALUES (" + values + ")");
}

/// The bytes of a study with a row in every table.
std::vector<std::uint8_t> makeStudy(const fuzz::ScratchFolder& folder) {
    const auto path = folder.path() / "whole.trap";
    {
        const auto settings = study::presetSettings("cuboid");
        fuzz::require(settings.ok(), "the preset is there");
        const store::StoredPart part{part::makeBox({0.01, 0.02, 0.03}), {.name = "box"}};
        const auto study = store::StudyFile::create(path, *settings, part, "fuzz");
        fuzz::require(study.ok(), "a study can be made");
    }
    {
        SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
        for (const std::string& table : listTables(database))
            addRow(database, table);
        database.exec("PRAGMA journal_mode = DELETE");
    }
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Column> listColumns(const std::filesystem::path& path) {
    SQLite::Database database(path.string());
    std::vector<Column> columns;
    for (const std::string& table : listTables(database)) {
        SQLite::Statement query(database, "SELECT name FROM pragma_table_info(?)");
        query.bind(1, table);
        while (query.executeStep())
            columns.push_back({table, query.getColumn(0).getString()});
    }
    return columns;
}

void damage(SQLite::Database& database, const std::vector<Column>& columns, FuzzedDataProvider& input) {
    const Column& column = columns[input.ConsumeIntegralInRange<std::size_t>(0, columns.size() - 1)];
    SQLite::Statement update(database, "UPDATE OR IGNORE " + column.table + " SET " + column.name + " = ?");
    constexpr std::size_t kLongest = 200;
    switch (input.ConsumeIntegralInRange(0, 4)) {
        case 0:
            update.bind(1, input.ConsumeIntegral<std::int64_t>());
            break;
        case 1:
            update.bind(1, input.ConsumeIntegralInRange(-1, 300));
            break;
        case 2:
            update.bind(1, input.ConsumeFloatingPoint<double>());
            break;
        case 3:
            update.bind(1, input.ConsumeRandomLengthString(kLongest));
            break;
        default: {
            const std::string blob = input.ConsumeRandomLengthString(kLongest);
            update.bind(1, blob.data(), static_cast<int>(blob.size()));
        }
    }
    try {
        update.exec();
    } catch (const SQLite::Exception&) {
        // SQLite itself refuses some values.
    }
}

}  // namespace

// A sound SQLite file with other values in it than this program would write.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::ScratchFolder folder;
    static const std::vector<std::uint8_t> whole = makeStudy(folder);
    const auto path = folder.keepOnly("study.trap", whole);
    static const std::vector<Column> columns = listColumns(path);
    FuzzedDataProvider input(data, size);
    {
        SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
        database.exec(
            "PRAGMA journal_mode = MEMORY; PRAGMA synchronous = OFF; PRAGMA ignore_check_constraints = ON");
        constexpr int kMostDamages = 6;
        for (int i = 0; i < kMostDamages && input.remaining_bytes() > 0; ++i)
            damage(database, columns, input);
    }
    fuzz::readWholeStudy(path);
    return 0;
}
