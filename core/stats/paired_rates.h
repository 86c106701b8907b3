#pragma once

/// Comparing two success rates on the same trials.
namespace trapwright::stats {

/// McNemar's test (1947) in its exact form, two-sided: the probability that trials which differ at all would
/// fall at least as unevenly if either way were equally probable. The trials that succeed, or fail, on both
/// sides tell nothing. Counts of trials that succeeded on one side only, not negative; none give 1.
double testMcNemar(int onlyFirst, int onlySecond);

}  // namespace trapwright::stats
