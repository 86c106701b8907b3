#pragma once

#include <span>

/// Comparing and summing up samples of numbers.
namespace trapwright::stats {

/// The middle value, or the mean of the two middle ones. At least one value, none NaN.
double medianOf(std::span<const double> values);

/// A quarter of the values is below the first, half below the second, three quarters below the third.
struct Quartiles {
    double lower = 0.0;
    double median = 0.0;
    double upper = 0.0;
};
/// Linear between neighbouring values (Hyndman and Fan 1996, definition 7). At least one value, none NaN.
Quartiles calcQuartiles(std::span<const double> values);

/// The two-sample Kolmogorov-Smirnov test: the largest difference of the empirical distributions, and the
/// exact probability that two samples from one continuous distribution differ at least as much (Kim and
/// Jennrich 1973; conservative with ties). Takes a time of size times size. Both samples have at least one
/// value, none NaN.
struct KolmogorovSmirnov {
    double statistic = 0.0;
    double p = 1.0;
};
KolmogorovSmirnov testKolmogorovSmirnov(std::span<const double> a, std::span<const double> b);

}  // namespace trapwright::stats
