#pragma once

// SQLite's types as the store's own headers name them; only .cpp files of core/store include the real ones.

namespace SQLite {  // NOLINT(readability-identifier-naming): the library's name
class Database;
class Statement;
}  // namespace SQLite
