#include "core/stats/samples.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace trapwright::stats {

namespace {

std::vector<double> sorted(std::span<const double> values) {
    std::vector<double> copy(values.begin(), values.end());
    std::sort(copy.begin(), copy.end());
    return copy;
}

// The statistic times na * nb, a whole number, so that equal differences compare equal.
std::int64_t calcScaledStatistic(std::span<const double> a, std::span<const double> b) {
    const auto x = sorted(a);
    const auto y = sorted(b);
    const auto nx = static_cast<std::int64_t>(x.size());
    const auto ny = static_cast<std::int64_t>(y.size());
    std::int64_t largest = 0;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < x.size() && j < y.size()) {
        // Step over all values equal to the next one in both samples before comparing.
        const double value = std::min(x[i], y[j]);
        while (i < x.size() && x[i] == value)
            ++i;
        while (j < y.size() && y[j] == value)
            ++j;
        const auto difference = static_cast<std::int64_t>(i) * ny - static_cast<std::int64_t>(j) * nx;
        largest = std::max(largest, std::abs(difference));
    }
    return largest;
}

// The probability that a random order of nx and ny values reaches the scaled statistic. All orders are
// equally probable; they are walks on the lattice from (0, 0) to (nx, ny). reached[j] is the share of the
// walks to (i, j) that have reached it already.
double calcReachProbability(std::int64_t nx, std::int64_t ny, std::int64_t statistic) {
    std::vector<double> reached(static_cast<std::size_t>(ny) + 1, 0.0);
    for (std::int64_t i = 0; i <= nx; ++i) {
        for (std::int64_t j = 0; j <= ny; ++j) {
            const auto k = static_cast<std::size_t>(j);
            if (std::abs(i * ny - j * nx) >= statistic) {
                reached[k] = 1.0;
            } else if (i + j > 0) {
                // Of the walks to (i, j), the share i / (i + j) comes from (i - 1, j).
                const double fromX = static_cast<double>(i) / static_cast<double>(i + j);
                const double before = j > 0 ? reached[k - 1] : 0.0;
                reached[k] = fromX * reached[k] + (1.0 - fromX) * before;
            }
        }
    }
    return reached.back();
}

}  // namespace

Quartiles calcQuartiles(std::span<const double> values) {
    assert(!values.empty());
    const std::vector<double> ordered = sorted(values);
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(ordered.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const std::size_t above = std::min(below + 1, ordered.size() - 1);
        return ordered[below] + (place - static_cast<double>(below)) * (ordered[above] - ordered[below]);
    };
    return {at(0.25), at(0.5), at(0.75)};
}

double medianOf(std::span<const double> values) {
    assert(!values.empty());
    const auto order = sorted(values);
    const std::size_t middle = order.size() / 2;
    if (order.size() % 2 == 1) return order[middle];
    return std::midpoint(order[middle - 1], order[middle]);
}

KolmogorovSmirnov testKolmogorovSmirnov(std::span<const double> a, std::span<const double> b) {
    assert(!a.empty() && !b.empty());
    const auto nx = static_cast<std::int64_t>(a.size());
    const auto ny = static_cast<std::int64_t>(b.size());
    const std::int64_t scaled = calcScaledStatistic(a, b);
    return {static_cast<double>(scaled) / static_cast<double>(nx * ny), calcReachProbability(nx, ny, scaled)};
}

}  // namespace trapwright::stats
