#pragma once

#include <span>
#include <vector>

/// Many tests in one table.
namespace trapwright::stats {

/// Holm's adjustment (1979): rejecting where the adjusted probability is at most a level rejects any true
/// hypothesis of the family with at most that probability, whatever the tests have to do with each other. In
/// the order given.
std::vector<double> adjustHolm(std::span<const double> probabilities);

}  // namespace trapwright::stats
