#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/settings.h"
#include "core/trial/engine_registry.h"
#include "core/trial/goal.h"

namespace trapwright::peers {

/// An engine at one step of simulated time.
struct Contender {
    trial::EngineKind kind;
    double step = 0.0;  // [s]; 0: the engine's own
};

/// Trials of the track that every engine gets.
struct TransferScene {
    std::string conditions;  // "as set", "over the box"
    trial::TrialBatch batch;
};

/// What one engine made of one scene.
struct TransferRow {
    std::string engine;
    double step = 0.0;      // [s]
    std::size_t scene = 0;  // which of the transfer's
    std::string problem;    // why this engine cannot do it; the rest is then empty
    std::vector<trial::Outcome> outcomes;
    std::vector<trial::Verdict> verdicts;
    trial::Tally tally;
};

/// A stretch of the track that parts go along, in place of all of it. [m]
struct Stretch {
    double from = 0.0;
    double to = 0.0;
};

/// How a track does in engines that it was not learned in.
struct Transfer {
    study::Settings settings;
    std::shared_ptr<const part::Part> part;
    std::vector<TransferScene> scenes;
    std::optional<Stretch> stretch;
    trial::Goal goal;               // what counts as success, in all engines
    std::vector<TransferRow> rows;  // engine by engine, all scenes of each; the first engine's are what the
                                    // others are held against
};

/// The scenes: so many trials as set, and as many all over the settings' operating box. They are the first of
/// those that study::measureRobustness() makes with these settings, whose ranges must not be cut off.
Transfer makeTransfer(const study::Settings& settings, const std::shared_ptr<const part::Part>& part,
                      const std::shared_ptr<const track::Track>& track, int trials);

/// Narrows the transfer down to a stretch: its trials begin as the parts of `engine` are and move when they
/// first come to where it begins, and finish where it ends, so that engines that part before it can be told
/// apart on it. Trials whose parts do not come so far there are left out, and none is longer than twice the
/// longest that comes to the stretch's end. Errors: a bowl, a stretch that ends behind the finish line, the
/// engine's, none that comes so far.
base::Status beginAtStretch(Transfer& transfer, const Stretch& stretch, const Contender& contender,
                            const base::RunControl& control);

/// Simulates all scenes in one engine, on one thread, and adds their rows. What the settings want is the
/// goal, or else the mode of the first engine's trials as set. Advances `control` by one per trial. Errors:
/// settings or part that cannot be used, a first engine that cannot do its trials, cancelled.
base::Status addEngine(Transfer& transfer, const Contender& contender, const base::RunControl& control);

/// As text: the head of the table, and a line of it.
std::string transferHeader(const Transfer& transfer);
std::string describeTransfer(const Transfer& transfer, const TransferRow& row);

/// As text, of a stretch: in which ways parts come to its end (study::findEndModes of all engines together),
/// how many of each engine do, how many trials end as in the first engine, and how far an engine is from it:
/// half the sum of the differences of their shares, those that do not come to the end being one way more.
/// Beside it what chance alone keeps below 95 times in 100, found by dealing both engines' trials out anew
/// (permutation test).
std::string describeWays(const Transfer& transfer);

/// Writes each trial in each engine as CSV: its conditions, verdict, farthest x and time.
base::Status writeTransferTrials(const Transfer& transfer, const std::filesystem::path& file);

}  // namespace trapwright::peers
