#include "core/stats/paired_rates.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cassert>

namespace trapwright::stats {

double testMcNemar(int onlyFirst, int onlySecond) {
    assert(onlyFirst >= 0 && onlySecond >= 0);
    const int differ = onlyFirst + onlySecond;
    if (differ == 0) return 1.0;
    const boost::math::binomial_distribution<> fair(differ, 0.5);
    return std::min(1.0, 2.0 * boost::math::cdf(fair, std::min(onlyFirst, onlySecond)));
}

}  // namespace trapwright::stats
