#pragma once

#include "core/store/sqlite_forward.h"

namespace trapwright::store {

// Inside core/store only: SQLite's types end here.

/// Schema version 8, once its new columns and tables are there: studies up to version 7 kept an individual's
/// genes (10 bits a number, 20 a strategy value), later ones its design, its traits, and the search's state
/// after the last generation. Gives the same designs and the same next generation, to the last bit. Throws
/// SQLite::Exception, SQLITE_CORRUPT if the genes are none.
void turnGenesIntoDesigns(SQLite::Database& database);

}  // namespace trapwright::store
