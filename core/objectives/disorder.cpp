#include "core/objectives/disorder.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/stats/mean.h"

namespace trapwright::objectives {

namespace {

// What a track has on which nothing finishes: more than parts that end at random ever have.
constexpr double kMostBits = 8.0;

Measured measureDisorder(const Evaluation& evaluation) {
    const std::vector<base::Quaternion> ends = trial::finalOrientations(evaluation.outcomes);
    const std::size_t parts = trial::countParts(evaluation.outcomes);
    if (ends.size() < 2) return {kMostBits};
    const trial::OrientationMetric metric(ends, *evaluation.symmetry, evaluation.distance);
    // Of each part the share of all others that end like it; 0 of one that does not finish.
    std::vector<double> alike(parts, 0.0);
    for (std::size_t j = 0; j < ends.size(); ++j) {
        for (std::size_t k = j + 1; k < ends.size(); ++k) {
            const double apart = metric.angle(j, k) / evaluation.tolerance;
            const double likeness = std::exp(-apart * apart);
            alike[j] += likeness;
            alike[k] += likeness;
        }
    }
    double sum = 0.0;
    for (double& share : alike) {
        share /= static_cast<double>(parts - 1);
        sum += share;
    }
    const double least = std::exp2(-kMostBits);
    const double likelihood = least + (1.0 - least) * sum / static_cast<double>(parts);
    // A mean over pairs is a U-statistic (see orientation()); the logarithm's slope makes bits of it.
    const double error = 2.0 * stats::calcStandardError(alike);
    return {-std::log2(likelihood), error / (likelihood * std::log(2.0))};
}

}  // namespace

Objective disorder() {
    Objective objective;
    objective.key = "disorder";
    objective.symbol = "Disorder";
    objective.name = "Disorder";
    objective.unit = "bit";
    objective.help =
        "In how many ways parts end: 0 is one way, 1 bit is two, 2 bits are four. Lower is better.";
    objective.decimals = 2;
    objective.moreIsBetter = false;
    objective.usesTolerance = true;
    objective.measure = &measureDisorder;
    objective.attainable = [](const Task&) { return 0.0; };
    return objective;
}

}  // namespace trapwright::objectives
