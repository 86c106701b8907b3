#include "core/stats/binomial.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <cassert>

namespace trapwright::stats {

namespace {

Interval findBounds(double successes, double failures, double confidence) {
    assert(confidence > 0.0 && confidence < 1.0);
    const double tail = 0.5 * (1.0 - confidence);
    Interval interval;
    if (successes > 0.0) {
        const boost::math::beta_distribution<> below(successes, failures + 1.0);
        interval.low = boost::math::quantile(below, tail);
    }
    if (failures > 0.0) {
        const boost::math::beta_distribution<> above(successes + 1.0, failures);
        interval.high = boost::math::quantile(above, 1.0 - tail);
    }
    return interval;
}

}  // namespace

Interval calcClopperPearson(int successes, int trials, double confidence) {
    assert(0 <= successes && successes <= trials);
    return findBounds(successes, trials - successes, confidence);
}

Interval calcEffectiveBounds(double share, double trials, double confidence) {
    assert(share >= 0.0 && share <= 1.0 && trials >= 0.0);
    return findBounds(share * trials, (1.0 - share) * trials, confidence);
}

int countPercentDecimals(double share) {
    constexpr int kFewest = 1;
    constexpr int kMost = 3;
    constexpr double kPercent = 100.0;
    const double rest = kPercent * std::min(share, 1.0 - share);
    int decimals = kFewest;
    for (double half = 0.05; decimals < kMost && rest > 0.0 && rest <= half; half *= 0.1)
        ++decimals;
    return decimals;
}

}  // namespace trapwright::stats
