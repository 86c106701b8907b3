#include "core/stats/binomial.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cassert>
#include <cmath>

namespace trapwright::stats {

Interval calcWilson(int successes, int trials, double confidence) {
    assert(0 <= successes && successes <= trials && confidence > 0.0 && confidence < 1.0);
    if (trials == 0) return {};
    const double n = trials;
    const double p = successes / n;
    const double z = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
    const double scale = 1.0 / (1.0 + z * z / n);
    const double centre = scale * (p + 0.5 * z * z / n);
    const double half = scale * z * std::sqrt(p * (1.0 - p) / n + 0.25 * z * z / (n * n));
    // The ends are exact where all or none succeed; rounding would miss them.
    return {successes == 0 ? 0.0 : std::max(0.0, centre - half),
            successes == trials ? 1.0 : std::min(1.0, centre + half)};
}

Interval calcClopperPearson(int successes, int trials, double confidence) {
    assert(0 <= successes && successes <= trials && confidence > 0.0 && confidence < 1.0);
    const double tail = 0.5 * (1.0 - confidence);
    Interval interval;
    if (successes > 0) {
        const boost::math::beta_distribution<> below(successes, trials - successes + 1);
        interval.low = boost::math::quantile(below, tail);
    }
    if (successes < trials) {
        const boost::math::beta_distribution<> above(successes + 1, trials - successes);
        interval.high = boost::math::quantile(above, 1.0 - tail);
    }
    return interval;
}

}  // namespace trapwright::stats
