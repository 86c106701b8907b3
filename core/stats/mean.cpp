#include "core/stats/mean.h"

#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <numeric>

namespace trapwright::stats {

namespace {

struct Moments {
    double mean = 0.0;
    double deviation = 0.0;  // with n - 1
};

/// Of at least two values.
Moments calcMoments(std::span<const double> values) {
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0.0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / (count - 1.0))};
}

}  // namespace

MeanEstimate estimateMean(std::span<const double> values, double confidence) {
    assert(values.size() >= 2 && confidence > 0.0 && confidence < 1.0);
    const auto count = static_cast<double>(values.size());
    MeanEstimate estimate;
    estimate.count = static_cast<int>(values.size());
    const Moments moments = calcMoments(values);
    estimate.mean = moments.mean;
    estimate.deviation = moments.deviation;
    const boost::math::students_t_distribution<> student(count - 1.0);
    const double half =
        boost::math::quantile(student, 0.5 + 0.5 * confidence) * estimate.deviation / std::sqrt(count);
    estimate.interval = {estimate.mean - half, estimate.mean + half};
    return estimate;
}

double calcStandardError(std::span<const double> values) {
    if (values.size() < 2) return 0.0;
    return calcMoments(values).deviation / std::sqrt(static_cast<double>(values.size()));
}

}  // namespace trapwright::stats
