#include "core/stats/family.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace trapwright::stats {

std::vector<double> adjustHolm(std::span<const double> probabilities) {
    std::vector<std::size_t> order(probabilities.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return probabilities[a] < probabilities[b]; });
    std::vector<double> adjusted(probabilities.size());
    double largest = 0.0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        // The smaller ones are rejected first; as many hypotheses as are left share the level.
        const double left = static_cast<double>(order.size() - rank);
        largest = std::max(largest, std::min(1.0, left * probabilities[order[rank]]));
        adjusted[order[rank]] = largest;
    }
    return adjusted;
}

}  // namespace trapwright::stats
