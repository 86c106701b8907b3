#include "sim/cluster/schedule.h"

#include <algorithm>
#include <cmath>

namespace trapwright::cluster {

std::size_t chooseShare(std::size_t left, double speed, double allSpeeds, bool isSpeedKnown) {
    const double even = static_cast<double>(left) * speed / allSpeeds / kShares;
    const double least = isSpeedKnown ? kLeastTime * speed : 1.0;
    const double share = std::ceil(std::max(even, least));
    return static_cast<std::size_t>(std::clamp(share, 1.0, static_cast<double>(left)));
}

}  // namespace trapwright::cluster
