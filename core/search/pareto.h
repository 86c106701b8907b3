#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trapwright::search {

/// How good something is in two ways that pull against each other; of both, the more the better.
using TwoScores = std::array<double, 2>;

/// Slot i for point i: how many fronts have to be taken away before nothing is as good as it in both ways and
/// better in one (Deb et al. 2002, non-dominated sorting). 0: it is on the Pareto front. Equal points are on
/// the same one.
std::vector<int> sortFronts(std::span<const TwoScores> points);

/// Indices of the Pareto front, the best of the first score first; of equal points the first alone.
std::vector<std::size_t> findFront(std::span<const TwoScores> points);

/// All indices, the best first, as NSGA-II compares them (Deb et al. 2002): front by front; within one its
/// two ends, then whoever has the most room between its neighbours, so that a front stays as long as it is;
/// among equals the lower index first.
std::vector<std::size_t> rankByFronts(std::span<const TwoScores> points);

}  // namespace trapwright::search
