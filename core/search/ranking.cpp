#include "core/search/ranking.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trapwright::search {

std::vector<std::size_t> rankByFitness(std::span<const double> fitnesses) {
    std::vector<std::size_t> order(fitnesses.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return fitnesses[a] > fitnesses[b]; });
    return order;
}

int countShare(std::size_t population, double share) {
    // 0.3 is a little more than three tenths in binary: 30 of 100, not 31.
    return static_cast<int>(std::ceil(share * static_cast<double>(population) - 1e-9));
}

std::vector<std::size_t> findTop(std::span<const double> fitnesses) {
    std::vector<std::size_t> order = rankByFitness(fitnesses);
    order.resize(static_cast<std::size_t>(countShare(fitnesses.size(), kTopShare)));
    return order;
}

}  // namespace trapwright::search
