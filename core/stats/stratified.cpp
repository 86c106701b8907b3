#include "core/stats/stratified.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/tools/roots.hpp>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

namespace trapwright::stats {

namespace {

constexpr double kCells = 2048.0;  // that the observed sum is divided into
constexpr double kRounding = 1e-7;

/// A kind as the sums below see it: what is counted is the rarer of successes and failures.
struct Kind {
    double weight = 0.0;  // the weights of all kinds sum to 1
    int trials = 0;
    int counted = 0;

    [[nodiscard]] double step() const { return weight / trials; }
};

double calcSum(const std::vector<Kind>& kinds) {
    double sum = 0.0;
    for (const Kind& kind : kinds)
        sum += kind.counted * kind.step();
    return sum;
}

/// The probabilities of the numbers that matter of a binomial distribution.
struct Numbers {
    int least = 0;
    std::vector<double> probabilities;
};

Numbers findNumbers(int trials, double rate) {
    constexpr double kNegligible = 1e-16;
    if (rate <= 0.0) return {0, {1.0}};
    if (rate >= 1.0) return {trials, {1.0}};
    const int mode = std::min(trials, static_cast<int>((trials + 1) * rate));
    const double peak = boost::math::pdf(boost::math::binomial_distribution<>(trials, rate), mode);
    const double odds = rate / (1.0 - rate);
    std::vector<double> below;
    double probability = peak;
    int least = mode;
    while (least > 0 && probability > kNegligible * peak) {
        probability *= least / (odds * (trials - least + 1.0));
        below.push_back(probability);
        --least;
    }
    Numbers numbers{least, {below.rbegin(), below.rend()}};
    numbers.probabilities.push_back(peak);
    probability = peak;
    for (int x = mode; x < trials && probability > kNegligible * peak; ++x) {
        probability *= odds * (trials - x) / (x + 1.0);
        numbers.probabilities.push_back(probability);
    }
    return numbers;
}

/// How probable weighted sums up to the observed one are, on a grid. Sums are rounded to the side that makes
/// the bounds wider.
class SumGrid {
 public:
    enum class Side { atMost, below };  // the observed sum

    SumGrid(const std::vector<Kind>& kinds, Side side) : kinds_(kinds), side_(side) {
        const double sum = calcSum(kinds);
        double least = kinds.front().step();
        for (const Kind& kind : kinds)
            least = std::min(least, kind.step());
        // A divisor of the least step leaves equal steps exact.
        cell_ = sum > 0.0 ? least / std::max(1.0, std::ceil(least * kCells / sum)) : least;
        if (sum / cell_ > 2.0 * kCells) cell_ = sum / kCells;
        limit_ = side == Side::atMost ? static_cast<int>(std::floor(sum / cell_ + kRounding))
                                      : static_cast<int>(std::ceil(sum / cell_ - kRounding)) - 1;
    }

    [[nodiscard]] double calcProbability(const std::vector<double>& rates) const {
        if (limit_ < 0) return 0.0;
        const auto size = static_cast<std::size_t>(limit_) + 1;
        std::vector<double> sums(size, 0.0);
        sums[0] = 1.0;
        std::size_t used = 1;  // sums beyond are 0
        for (std::size_t i = 0; i + 1 < kinds_.size(); ++i) {
            std::vector<double> longer(size, 0.0);
            std::size_t reached = 0;
            forEachNumber(i, rates[i], [&](std::size_t cells, double probability) {
                const std::size_t end = std::min(used, size - cells);
                for (std::size_t j = 0; j < end; ++j)
                    longer[cells + j] += probability * sums[j];
                reached = std::max(reached, cells + end);
            });
            sums.swap(longer);
            used = reached;
        }
        for (std::size_t j = 1; j < size; ++j)
            sums[j] += sums[j - 1];
        double total = 0.0;
        forEachNumber(kinds_.size() - 1, rates.back(), [&](std::size_t cells, double probability) {
            total += probability * sums[size - 1 - cells];
        });
        return std::min(total, 1.0);
    }

 private:
    template <class Use>
    void forEachNumber(std::size_t kind, double rate, const Use& use) const {
        const Numbers numbers = findNumbers(kinds_[kind].trials, rate);
        for (std::size_t n = 0; n < numbers.probabilities.size(); ++n) {
            const double exact = (numbers.least + static_cast<double>(n)) * kinds_[kind].step() / cell_;
            const double cells =
                side_ == Side::atMost ? std::floor(exact + kRounding) : std::ceil(exact - kRounding);
            if (cells > limit_) return;
            use(static_cast<std::size_t>(cells), numbers.probabilities[n]);
        }
    }

    const std::vector<Kind>& kinds_;
    Side side_;
    double cell_ = 1.0;
    int limit_ = 0;
};

/// The most likely rates, given the counts, whose weighted sum is `sum`.
std::vector<double> findLikeliest(const std::vector<Kind>& kinds, double sum) {
    std::vector<double> rates(kinds.size());
    // Lagrange: x / q - (n - x) / (1 - q) = pull * weight, a quadratic equation for each rate q.
    const auto calcSumAt = [&](double pull) {
        double total = 0.0;
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            const double a = pull * kinds[i].weight;
            const double b = kinds[i].trials + a;
            const double counted = kinds[i].counted;
            const double root = std::sqrt(std::max(0.0, b * b - 4.0 * a * counted));
            const double rate =
                b >= 0.0 ? (b + root > 0.0 ? 2.0 * counted / (b + root) : 0.0) : (b - root) / (2.0 * a);
            rates[i] = std::clamp(rate, 0.0, 1.0);
            total += kinds[i].weight * rates[i];
        }
        return total;
    };
    double low = -1.0;  // the sum falls with the pull
    double high = 1.0;
    for (int i = 0; i < 200 && calcSumAt(low) < sum; ++i)
        low *= 2.0;
    for (int i = 0; i < 200 && calcSumAt(high) > sum; ++i)
        high *= 2.0;
    for (int i = 0; i < 100 && high - low > 1e-13 * (std::abs(low) + std::abs(high)); ++i) {
        const double middle = 0.5 * (low + high);
        (calcSumAt(middle) > sum ? low : high) = middle;
    }
    calcSumAt(0.5 * (low + high));
    return rates;
}

/// Where a monotone function crosses 0.
template <class Function>
double findCrossing(const Function& function, double low, double high) {
    std::uintmax_t steps = 60;
    const auto found = boost::math::tools::toms748_solve(
        function, low, high, boost::math::tools::eps_tolerance<double>(30), steps);
    return 0.5 * (found.first + found.second);
}

/// Bounds of the weighted rate of what is counted.
Interval calcBounds(const std::vector<Kind>& kinds, double tail) {
    const double sum = calcSum(kinds);
    const auto calcWith = [&](const SumGrid& grid, double rate, auto worse) {
        return worse(grid.calcProbability(findLikeliest(kinds, rate)),
                     grid.calcProbability(std::vector<double>(kinds.size(), rate)));
    };
    const auto greatest = [](double a, double b) { return std::max(a, b); };
    const auto least = [](double a, double b) { return std::min(a, b); };
    Interval interval;
    if (sum < 1.0 - 1e-12) {
        const SumGrid grid(kinds, SumGrid::Side::atMost);
        const auto excess = [&](double rate) { return calcWith(grid, rate, greatest) - tail; };
        interval.high = findCrossing(excess, sum, 1.0);
    }
    if (sum > 0.0) {
        const SumGrid grid(kinds, SumGrid::Side::below);
        const auto excess = [&](double rate) { return 1.0 - tail - calcWith(grid, rate, least); };
        interval.low = findCrossing(excess, 0.0, sum);
    }
    return interval;
}

}  // namespace

WeightedRate estimateWeighted(std::span<const Stratum> strata, double confidence) {
    assert(confidence > 0.0 && confidence < 1.0);
    double whole = 0.0;
    double tried = 0.0;
    double successes = 0.0;  // weighted
    for (const Stratum& stratum : strata) {
        const Count& count = stratum.count;
        assert(stratum.weight >= 0.0 && 0 <= count.successes && count.successes <= count.trials);
        whole += stratum.weight;
        if (count.trials == 0) continue;
        tried += stratum.weight;
        successes += stratum.weight * count.successes / count.trials;
    }
    if (!(tried > 0.0)) return {};

    const bool failuresAreRarer = successes > 0.5 * tried;
    std::vector<Kind> kinds;
    bool untried = false;
    for (const Stratum& stratum : strata) {
        if (!(stratum.weight > 0.0)) continue;
        const Count& count = stratum.count;
        untried = untried || count.trials == 0;
        if (count.trials > 0)
            kinds.push_back({stratum.weight / tried, count.trials,
                             failuresAreRarer ? count.trials - count.successes : count.successes});
    }
    Interval interval = calcBounds(kinds, 0.5 * (1.0 - confidence));
    if (failuresAreRarer) interval = {1.0 - interval.high, 1.0 - interval.low};
    const double share = untried ? tried / whole : 1.0;
    return {calcWeightedRate(strata), {share * interval.low, share * interval.high + (1.0 - share)}};
}

std::optional<double> calcWeightedRate(std::span<const Stratum> strata) {
    double weights = 0.0;
    double successes = 0.0;
    for (const Stratum& stratum : strata) {
        if (!(stratum.weight > 0.0)) continue;
        if (stratum.count.trials == 0) return std::nullopt;
        weights += stratum.weight;
        successes += stratum.weight * stratum.count.successes / stratum.count.trials;
    }
    if (!(weights > 0.0)) return std::nullopt;
    return successes / weights;
}

std::vector<Stratum> countRight(std::span<const ArrivalStratum> strata) {
    std::vector<Stratum> counted;
    counted.reserve(strata.size());
    for (const ArrivalStratum& kind : strata)
        counted.push_back({kind.weight, {kind.right, kind.trials}});
    return counted;
}

std::vector<Stratum> countArrived(std::span<const ArrivalStratum> strata) {
    std::vector<Stratum> counted;
    counted.reserve(strata.size());
    for (const ArrivalStratum& kind : strata)
        counted.push_back({kind.weight, {kind.arrived, kind.trials}});
    return counted;
}

WeightedRate estimateCorrect(std::span<const ArrivalStratum> strata, double confidence) {
    double arrived = 0.0;  // of the mixture
    double right = 0.0;
    double squares = 0.0;  // of the weights of the trials that arrived
    for (const ArrivalStratum& kind : strata) {
        if (kind.weight <= 0.0) continue;
        if (kind.trials == 0) return {};
        const double each = kind.weight / kind.trials;
        arrived += each * kind.arrived;
        right += each * kind.right;
        squares += each * each * kind.arrived;
    }
    if (!(arrived > 0.0)) return {};
    const double share = right / arrived;
    // Of `right - share * arrived`, whose mean is 0: a trial adds 1 - share, -share, or nothing.
    double variance = 0.0;
    for (const ArrivalStratum& kind : strata) {
        if (kind.weight <= 0.0) continue;
        const double trials = kind.trials;
        const double isRight = kind.right / trials;
        const double isWrong = (kind.arrived - kind.right) / trials;
        const double mean = (1.0 - share) * isRight - share * isWrong;
        const double square = (1.0 - share) * (1.0 - share) * isRight + share * share * isWrong;
        variance += kind.weight * kind.weight * std::max(0.0, square - mean * mean) / trials;
    }
    variance /= arrived * arrived;
    double worth = arrived * arrived / squares;
    const double spread = share * (1.0 - share);
    if (spread > 0.0 && variance > 0.0) worth = std::min(worth, spread / variance);
    return {share, calcEffectiveBounds(share, worth, confidence)};
}

}  // namespace trapwright::stats
