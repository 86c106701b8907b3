#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/study/mending.h"

namespace trapwright::fake {

/// A learned track of which a little cannot be printed by these limits.
struct FlawedTrack {
    study::Individual track;
    geometry::PrintLimits limits;
};

/// The one of these generations of which least cannot be printed; none if all can, up to walls of 6 mm.
inline std::optional<FlawedTrack> findFlawedTrack(const study::TrackSettings& settings,
                                                  std::span<const study::GenerationRecord> generations) {
    std::optional<FlawedTrack> found;
    double least = 0.0;
    geometry::PrintLimits limits;
    for (limits.thinnestWall = 1.2e-3; !found && limits.thinnestWall < 6e-3; limits.thinnestWall *= 1.5) {
        for (const study::GenerationRecord& generation : generations) {
            for (std::size_t i = 0; i < generation.individuals.size(); ++i) {
                const study::IndividualRecord& record = generation.individuals[i];
                const auto area = study::measureUnprintable(settings, record.design, limits);
                if (!area || *area <= 0.0 || (found && *area >= least)) continue;
                found = FlawedTrack{{{generation.index, static_cast<int>(i)}, record}, limits};
                least = *area;
            }
        }
    }
    return found;
}

}  // namespace trapwright::fake
