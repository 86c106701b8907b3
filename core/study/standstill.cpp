#include "core/study/standstill.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trapwright::study {

namespace {

constexpr std::size_t kWindow = 8;   // generations
constexpr double kErrors = 2.5;      // a gain is more than so many of its standard errors
constexpr double kLeastGain = 0.01;  // and than this share of all that was gained

struct Window {
    double mean = 0.0;
    double error = 0.0;  // standard error of it, from the scatter about a straight line
};

/// What rises all the time does not scatter.
Window average(std::span<const double> values) {
    const auto count = static_cast<double>(values.size());
    Window window;
    for (const double value : values)
        window.mean += value / count;
    double products = 0.0;
    double places = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double place = static_cast<double>(i) - 0.5 * (count - 1.0);
        products += place * values[i];
        places += place * place;
    }
    const double slope = products / places;
    double squares = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double place = static_cast<double>(i) - 0.5 * (count - 1.0);
        const double off = values[i] - window.mean - slope * place;
        squares += off * off;
    }
    window.error = std::sqrt(squares / (count - 2.0) / count);
    return window;
}

}  // namespace

std::optional<int> findStandstill(std::span<const GenerationSummary> summaries) {
    if (summaries.size() < 2 * kWindow) return std::nullopt;
    std::vector<double> fitness;
    fitness.reserve(summaries.size());
    for (const GenerationSummary& summary : summaries)
        fitness.push_back(summary.statistics.topMean.total);
    const auto windowAt = [&](std::size_t first) {
        return average(std::span(fitness).subspan(first, kWindow));
    };
    const Window last = windowAt(fitness.size() - kWindow);
    const double whole = last.mean - *std::min_element(fitness.begin(), fitness.end());
    std::optional<int> since;
    for (std::size_t first = fitness.size() - 2 * kWindow + 1; first-- > 0;) {
        const Window before = windowAt(first);
        const double gain = last.mean - before.mean;
        if (gain > kErrors * std::hypot(last.error, before.error) && gain > kLeastGain * whole) break;
        since = summaries[first].index;
    }
    return since;
}

}  // namespace trapwright::study
