#pragma once

#include "core/base/random.h"
#include "core/track/encoding.h"
#include "core/track/track_builder.h"

namespace trapwright::testing {

/// A trap with every gene value drawn at random.
inline std::vector<track::CrossSection> drawTrap(const track::Encoding& encoding, std::uint64_t seed) {
    base::Random random({seed, 0, 0, 0, base::Purpose::test});
    std::vector<double> points(encoding.pointValues());
    std::vector<double> lengths(encoding.lengthValues());
    for (double& value : points)
        value = random.uniform();
    for (double& value : lengths)
        value = random.uniform();
    return track::decodeTrap(encoding, points, lengths);
}

inline track::FeederShape makeBowl(track::Conveying conveying) {
    return {track::FeederType::bowl, 0.175, conveying};
}

}  // namespace trapwright::testing
