#pragma once

#include <span>

#include "core/base/result.h"
#include "core/store/sqlite_forward.h"

namespace trapwright::store {

// Inside core/store only: SQLite's types end here.

/// Marks a SQLite file as a study, in its header ("Trap" in ASCII).
inline constexpr int kApplicationId = 0x54726170;

/// One step of the schema. Steps are never changed once released; a new one is added.
struct Migration {
    int version;                                         // the user_version that the file has afterwards
    const char* sql;                                     // may hold several statements
    void (*then)(SQLite::Database& database) = nullptr;  // what SQL cannot do
};

/// All steps, from an empty database to the schema of this program.
std::span<const Migration> schemaMigrations();

/// The user_version that this program writes.
int currentSchemaVersion();

/// Runs those steps that the database has not seen, all in one transaction: a failure leaves it as it was.
/// Throws SQLite::Exception.
void migrate(SQLite::Database& database, std::span<const Migration> migrations);

}  // namespace trapwright::store
