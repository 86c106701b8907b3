#pragma once

/// Confidence bounds of a success rate.
namespace trapwright::stats {

struct Interval {
    double low = 0.0;
    double high = 1.0;
};

/// How often something succeeded.
struct Count {
    int successes = 0;
    int trials = 0;  // at least successes

    /// successes / trials; there must be trials.
    [[nodiscard]] double share() const { return static_cast<double>(successes) / trials; }

    friend bool operator==(const Count&, const Count&) = default;
};

/// Clopper and Pearson's interval (1934): at least the stated coverage, always. It is the one of every single
/// rate that Trapwright shows. 0 <= successes <= trials; no trials give [0, 1]. confidence in (0, 1),
/// two-sided.
Interval calcClopperPearson(int successes, int trials, double confidence = 0.95);

/// The same of numbers that need not be whole, as of trials that count unequally: share in [0, 1] of so many.
Interval calcEffectiveBounds(double share, double trials, double confidence = 0.95);

/// Decimals with which a share in [0, 1] is shown in percent: one, or up to two more where one would make
/// nearly all look like all, or hardly any like none ("99.96 %").
int countPercentDecimals(double share);

}  // namespace trapwright::stats
