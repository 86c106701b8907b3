#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/stats/binomial.h"

/// The success rate of a mixture whose kinds are tried one by one.
namespace trapwright::stats {

/// One kind, and how often it is met.
struct Stratum {
    double weight = 0.0;  // share of the mixture; the weights of all strata need not sum to 1
    Count count;
};

struct WeightedRate {
    std::optional<double> rate;  // sum of weight times rate; none while a kind that is met was never tried
    Interval interval;
};

/// Estimates the weighted sum of independent success rates. The bounds invert the exact test whose statistic
/// is the estimate itself: the greatest weighted rate at which so few successes, or fewer, still have half of
/// 1 - confidence (Buehler 1957). Which rates of the single kinds make up a weighted rate is not known: the
/// most likely ones that do, given the counts (profile limits, Kabaila and Lloyd 2000), or one rate common to
/// all, whichever is worse. One stratum gives Clopper and Pearson's bounds; so do equal weights and trials,
/// for all trials pooled (Hoeffding 1956: no other rates are worse). Kinds that were never tried may succeed
/// always or never. Strata of weight 0 do not matter. confidence in (0, 1), two-sided. Takes milliseconds,
/// 0.1 s for strata of several 1000 trials.
WeightedRate estimateWeighted(std::span<const Stratum> strata, double confidence = 0.95);

/// The rate alone, at once: the sum of weight times rate over the weights that are met. None while a kind
/// that is met was never tried.
std::optional<double> calcWeightedRate(std::span<const Stratum> strata);

/// A kind of which some trials arrive, and some of these are right.
struct ArrivalStratum {
    double weight = 0.0;  // share of the mixture
    int trials = 0;
    int arrived = 0;
    int right = 0;  // of these
};

/// The right ones of all trials, kind by kind.
std::vector<Stratum> countRight(std::span<const ArrivalStratum> strata);
/// Those that arrived, of all trials.
std::vector<Stratum> countArrived(std::span<const ArrivalStratum> strata);

/// The right ones' share of those that arrive, of the mixture: a ratio of two weighted rates. Bounds: those
/// of Clopper and Pearson for as many trials as tell a share that well by themselves (Korn and Graubard
/// 1998), after the variance of the ratio to first order, and no more than the trials that arrived are worth
/// by their unequal weights (Kish 1965). None if nothing arrived, or a kind that is met was never tried.
WeightedRate estimateCorrect(std::span<const ArrivalStratum> strata, double confidence = 0.95);

}  // namespace trapwright::stats
