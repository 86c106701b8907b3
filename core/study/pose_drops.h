#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/part/part.h"
#include "core/stats/binomial.h"
#include "core/trial/engine.h"

namespace trapwright::study {

inline constexpr int kMostDrops = 1000000;
inline constexpr double kGreatestDropHeight = 1.0;  // [m]

/// How parts are dropped to find how likely they come to rest in each stable pose.
struct DropSettings {
    int drops = 1000;
    double height = 30e-3;  // of the part's lowest point above the plane [m]
    trial::ContactParameters contact;
    double gravity = base::kStandardGravity;  // [m/s^2]
    std::uint64_t seed = 1;

    friend bool operator==(const DropSettings& a, const DropSettings& b);
};

/// How often dropped parts came to rest in each of the part's stable poses.
struct DropResult {
    std::vector<int> counts;  // one per stable pose
    int unsettled = 0;  // still moving 6 s after the fall, in none of the poses, or rolled off the plane

    [[nodiscard]] int drops() const;
    /// Adds the counts of other drops of the same part.
    void add(const DropResult& other);
    friend bool operator==(const DropResult&, const DropResult&) = default;
};

/// A drop test as a study keeps it: what was dropped, how, and how it came to rest.
struct DropRecord {
    DropSettings settings;
    std::string engine;
    std::vector<base::Quaternion> poses;  // the part's stable poses when it was dropped
    DropResult result;
    std::string time{};  // UTC, ISO 8601

    /// The share that came to rest in a pose, of all drops, with its 95 % Clopper-Pearson bounds.
    [[nodiscard]] double share(std::size_t pose) const;
    [[nodiscard]] stats::Interval bounds(std::size_t pose) const;
    friend bool operator==(const DropRecord& a, const DropRecord& b);
};

/// What is wrong with the settings, as sentences; empty if all is well.
std::vector<std::string> findProblems(const DropSettings& settings);

/// Drops the part in random orientations on a level, resting plane and sees where it comes to rest: the
/// dynamic counterpart of the quasi-static probabilities in Part::stablePoses. A part that still rolls after
/// 6 s, and lies as low as it can, counts as at rest in that pose: no rolling resistance is simulated. Drop i
/// is the same whichever are simulated with it: `count` drops from `first` on; count < 0: all that are left.
/// `control` counts drops. Errors: the settings'; the engine's; cancelled.
base::Result<DropResult> simulateDrops(const trial::Engine& engine, std::shared_ptr<const part::Part> part,
                                       const DropSettings& settings, unsigned threads,
                                       base::RunControl control, int first = 0, int count = -1);

/// The record of a test that was made with this part.
DropRecord makeDropRecord(const part::Part& part, const DropSettings& settings, std::string engine,
                          DropResult result);
/// Whether the part still has the stable poses that the test counted, so that its shares hold for it.
bool holdsFor(const DropRecord& record, const part::Part& part);

}  // namespace trapwright::study
