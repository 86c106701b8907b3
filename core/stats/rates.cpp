#include "core/stats/rates.h"

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace trapwright::stats {

namespace {

// Probabilities that are equal in theory differ by rounding.
constexpr double kEqual = 1.0 + 1e-7;

/// How probable each number of a's successes is, given how many succeed in all, if the rates are equal (the
/// hypergeometric distribution).
struct Divisions {
    int least = 0;  // successes of a that the first probability belongs to
    std::vector<double> probabilities;
};

Divisions divide(int trialsA, int trialsB, int successes) {
    const int least = std::max(0, successes - trialsB);
    const int most = std::min(trialsA, successes);
    Divisions divisions{least, std::vector<double>(static_cast<std::size_t>(most - least) + 1)};
    std::vector<double>& weights = divisions.probabilities;
    // From one number to the next the probability changes by a ratio of whole numbers; from the mode outward
    // nothing overflows, and what underflows does not matter.
    const auto ratio = [&](int x) {
        return (static_cast<double>(trialsA - x) * (successes - x)) /
               ((x + 1.0) * (trialsB - successes + x + 1.0));
    };
    const double expected = (trialsA + 1.0) * (successes + 1.0) / (trialsA + trialsB + 2.0);
    const int mode = std::clamp(static_cast<int>(expected), least, most);
    weights[static_cast<std::size_t>(mode - least)] = 1.0;
    for (int x = mode; x < most; ++x) {
        const auto i = static_cast<std::size_t>(x - least);
        weights[i + 1] = weights[i] * ratio(x);
    }
    for (int x = mode; x > least; --x) {
        const auto i = static_cast<std::size_t>(x - least);
        weights[i - 1] = weights[i] / ratio(x - 1);
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights)
        weight /= sum;
    return divisions;
}

double sumUpTo(const std::vector<double>& probabilities, double limit) {
    double sum = 0.0;
    for (const double probability : probabilities)
        if (probability <= limit * kEqual) sum += probability;
    return std::min(1.0, sum);
}

/// The greatest Fisher probability of these divisions that is at most `level`; 0 if none is.
double findAttainedLevel(const std::vector<double>& probabilities, double level) {
    // They rise to the mode and fall after it, so the least one left is always at an end.
    std::size_t first = 0;
    std::size_t last = probabilities.size();
    double attained = 0.0;
    double sum = 0.0;
    while (first < last) {
        const double least = std::min(probabilities[first], probabilities[last - 1]);
        while (first < last && probabilities[first] <= least * kEqual)
            sum += probabilities[first++];
        while (first < last && probabilities[last - 1] <= least * kEqual)
            sum += probabilities[--last];
        if (sum > level * kEqual) return attained;
        attained = sum;
    }
    return attained;
}

/// The mean of levels[s] over s successes in all at this common rate.
double averageLevel(const std::vector<double>& levels, double rate) {
    constexpr double kNegligible = 1e-18;
    const int trials = static_cast<int>(levels.size()) - 1;
    const int mode = std::min(trials, static_cast<int>((trials + 1) * rate));
    const double peak = boost::math::pdf(boost::math::binomial_distribution<>(trials, rate), mode);
    const double odds = rate / (1.0 - rate);
    double mean = peak * levels[static_cast<std::size_t>(mode)];
    double probability = peak;
    for (int s = mode; s < trials && probability > kNegligible; ++s) {
        probability *= odds * (trials - s) / (s + 1.0);
        mean += probability * levels[static_cast<std::size_t>(s) + 1];
    }
    probability = peak;
    for (int s = mode; s > 0 && probability > kNegligible; --s) {
        probability *= s / (odds * (trials - s + 1.0));
        mean += probability * levels[static_cast<std::size_t>(s) - 1];
    }
    return mean;
}

/// The greatest of them over all rates.
double maximizeLevel(const std::vector<double>& levels) {
    // With rate = sin(angle)^2 the binomial's width in the angle, 1 / (2 sqrt(n)), is the same everywhere,
    // and no peak of the mean is much narrower. A grid finds each, a section search its top.
    const auto levelAt = [&](double angle) {
        const double sine = std::sin(angle);
        return averageLevel(levels, sine * sine);
    };
    const int count = 64 + static_cast<int>(16.0 * std::sqrt(static_cast<double>(levels.size())));
    const double step = 0.5 * std::numbers::pi / count;
    std::vector<double> grid(static_cast<std::size_t>(count) + 1, 0.0);  // a rate of 0 or 1 rejects nothing
    for (int i = 1; i < count; ++i)
        grid[static_cast<std::size_t>(i)] = levelAt(i * step);
    double greatest = *std::max_element(grid.begin(), grid.end());
    const double worthRefining = 0.98 * greatest;
    for (int i = 1; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (grid[k] < worthRefining || grid[k] < grid[k - 1] || grid[k] < grid[k + 1]) continue;
        double low = (i - 1) * step;  // never tried itself, so that the rate stays inside (0, 1)
        double high = (i + 1) * step;
        for (int cut = 0; cut < 40; ++cut) {
            const double left = low + (high - low) / 3.0;
            const double right = high - (high - low) / 3.0;
            if (levelAt(left) < levelAt(right)) {
                low = left;
            } else {
                high = right;
            }
        }
        greatest = std::max(greatest, levelAt(0.5 * (low + high)));
    }
    return greatest;
}

}  // namespace

double testFisher(const RatePair& pair) {
    return testFisher({&pair, 1});
}

double testFisher(std::span<const RatePair> pairs) {
    std::vector<double> sums{1.0};  // how probable each number of all a's successes is
    int observed = 0;
    for (const RatePair& pair : pairs) {
        assert(0 <= pair.a.successes && pair.a.successes <= pair.a.trials);
        assert(0 <= pair.b.successes && pair.b.successes <= pair.b.trials);
        const Divisions divisions = divide(pair.a.trials, pair.b.trials, pair.a.successes + pair.b.successes);
        observed += pair.a.successes - divisions.least;
        std::vector<double> longer(sums.size() + divisions.probabilities.size() - 1, 0.0);
        for (std::size_t i = 0; i < sums.size(); ++i)
            for (std::size_t j = 0; j < divisions.probabilities.size(); ++j)
                longer[i + j] += sums[i] * divisions.probabilities[j];
        sums = std::move(longer);
    }
    return sumUpTo(sums, sums[static_cast<std::size_t>(observed)]);
}

double testBoschloo(const RatePair& pair) {
    const double fisher = testFisher(pair);
    // A table is rejected if its own Fisher probability is that small. Given the successes in all, the
    // probability of that is the greatest Fisher probability there that is not larger than `fisher`; they are
    // binomially distributed at any common rate.
    const int trials = pair.a.trials + pair.b.trials;
    std::vector<double> levels;
    levels.reserve(static_cast<std::size_t>(trials) + 1);
    for (int successes = 0; successes <= trials; ++successes) {
        levels.push_back(
            findAttainedLevel(divide(pair.a.trials, pair.b.trials, successes).probabilities, fisher));
    }
    // No successes divide in one way only: that is rejected if everything is.
    if (levels.front() > 0.0) return fisher;
    return std::min(fisher, maximizeLevel(levels));
}

double testMcNemar(int onlyFirst, int onlySecond) {
    assert(onlyFirst >= 0 && onlySecond >= 0);
    const int differ = onlyFirst + onlySecond;
    if (differ == 0) return 1.0;
    const boost::math::binomial_distribution<> fair(differ, 0.5);
    return std::min(1.0, 2.0 * boost::math::cdf(fair, std::min(onlyFirst, onlySecond)));
}

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
