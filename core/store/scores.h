#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/objectives/objectives.h"
#include "core/store/sqlite_forward.h"

namespace trapwright::store {

// Inside core/store only.

/// Whose scores a child table holds: its name, and the columns that name the owner.
struct ScoreTable {
    std::string_view name;
    std::vector<std::string_view> owner;
    bool hasErrors = true;
};

inline const ScoreTable kIndividualScores{"score", {"generation", "individual"}};
inline const ScoreTable kTopScores{"top_score", {"generation"}, false};
inline const ScoreTable kSelectionScores{"selection_score", {"selection", "rank"}};
inline const ScoreTable kCheckScores{"check_score", {"generation", "engine"}};

/// Writes scores. An objective that the study has not met gets its row of the table of objectives.
class ScoreWriter {
 public:
    ScoreWriter(SQLite::Database& database, const ScoreTable& table);
    ScoreWriter(const ScoreWriter&) = delete;
    ScoreWriter& operator=(const ScoreWriter&) = delete;
    ~ScoreWriter();

    void write(const std::vector<int>& owner, const std::vector<objectives::Score>& scores);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Reads them back, in the order of the table of objectives.
class ScoreReader {
 public:
    ScoreReader(SQLite::Database& database, const ScoreTable& table);
    ScoreReader(const ScoreReader&) = delete;
    ScoreReader& operator=(const ScoreReader&) = delete;
    ~ScoreReader();

    /// None if one is of an objective that the table of objectives has not: the study is damaged.
    [[nodiscard]] std::optional<std::vector<objectives::Score>> read(const std::vector<int>& owner);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::store
