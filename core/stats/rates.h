#pragma once

#include <span>
#include <vector>

#include "core/stats/binomial.h"

/// Comparing success rates: of trials of their own, of the same trials, and many comparisons in one table.

namespace trapwright::stats {

/// Two rates that are compared.
struct RatePair {
    Count a;
    Count b;
};

/// Fisher's exact test (1935), two-sided: the probability, given how many succeed in all, of every division
/// of the successes that is at most as probable as this one. 1 where a side has no trials.
double testFisher(const RatePair& pair);

/// The same over several pairs, each with a common rate of its own (Gart 1970, Mehta, Patel and Gray 1985):
/// the test of the sum of all a's successes. Right whatever share of the trials each pair has on either side;
/// one pair gives Fisher's test.
double testFisher(std::span<const RatePair> pairs);

/// Boschloo's exact test (1970), two-sided: the greatest probability over all common rates of a Fisher
/// probability as small as this one. Never more than testFisher(), and still at most the stated level wrong
/// where the rates are equal. Takes a time of a.trials times b.trials: 0.1 s for 6000 and 600.
double testBoschloo(const RatePair& pair);

/// McNemar's test (1947) in its exact form, two-sided: the probability that trials which differ at all would
/// fall at least as unevenly if either way were equally probable. The trials that succeed, or fail, on both
/// sides tell nothing. Counts of trials that succeeded on one side only, not negative; none give 1.
double testMcNemar(int onlyFirst, int onlySecond);

/// Holm's adjustment (1979): rejecting where the adjusted probability is at most a level rejects any true
/// hypothesis of the family with at most that probability, whatever the tests have to do with each other. In
/// the order given.
std::vector<double> adjustHolm(std::span<const double> probabilities);

}  // namespace trapwright::stats
