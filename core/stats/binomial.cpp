#include "core/stats/binomial.h"

#include <boost/math/distributions/beta.hpp>
#include <cassert>

namespace trapwright::stats {

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
