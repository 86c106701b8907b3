#pragma once

#include <span>

#include "core/stats/binomial.h"

/// The mean of repeated measurements.
namespace trapwright::stats {

struct MeanEstimate {
    double mean = 0.0;
    double deviation = 0.0;  // of one measurement, with n - 1
    Interval interval;       // of the mean
    int count = 0;
};

/// Student's interval (1908) of the mean of normally distributed measurements. At least two values, none NaN.
/// confidence in (0, 1), two-sided.
MeanEstimate estimateMean(std::span<const double> values, double confidence = 0.95);

/// Standard error of the mean: the deviation with n - 1 over the root of n. 0 for fewer than two values.
double calcStandardError(std::span<const double> values);

}  // namespace trapwright::stats
