#pragma once

#include <span>

#include "core/stats/binomial.h"

/// Comparing success rates on trials of their own.
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

}  // namespace trapwright::stats
