#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/part/part.h"
#include "core/trial/engine.h"

namespace trapwright::study {

/// How parts are dropped to find how likely they come to rest in each stable pose.
struct DropSettings {
    int drops = 1000;
    double height = 30e-3;  // of the part's lowest point above the plane [m]
    trial::ContactParameters contact;
    double gravity = base::kStandardGravity;  // [m/s^2]
    std::uint64_t seed = 1;
};

/// How often dropped parts came to rest in each of the part's stable poses.
struct DropResult {
    std::vector<int> counts;  // one per stable pose
    int unsettled = 0;        // still moving after 2 s, in none of the poses, or rolled off the plane
};

/// Drops the part in random orientations on a level, resting plane and sees where it comes to rest: the
/// dynamic counterpart of the quasi-static probabilities in Part::stablePoses. Errors: the engine's;
/// cancelled.
base::Result<DropResult> simulateDrops(const trial::Engine& engine, std::shared_ptr<const part::Part> part,
                                       const DropSettings& settings, unsigned threads,
                                       base::RunControl control);

}  // namespace trapwright::study
