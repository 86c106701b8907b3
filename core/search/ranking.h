#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace trapwright::search {

/// The share of a population whose mean is shown (Figures 6 and 7; decisions.md#distance-and-statistics).
inline constexpr double kTopShare = 0.3;

/// All indices, the fittest first; among equals the lower index first.
std::vector<std::size_t> rankByFitness(std::span<const double> fitnesses);

/// How many of a population a share of it is, rounded up.
int countShare(std::size_t population, double share);

/// Indices of the best kTopShare of a population (rounded up), best first; among equals the lower index
/// first. So the first is the winner.
std::vector<std::size_t> findTop(std::span<const double> fitnesses);

}  // namespace trapwright::search
