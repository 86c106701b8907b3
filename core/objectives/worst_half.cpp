#include "core/objectives/worst_half.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/objectives/success_share.h"

namespace trapwright::objectives {

namespace {

Measured measureWorstHalf(const Evaluation& evaluation) {
    const Measured all = successShare().measure(evaluation);
    if (evaluation.places.empty() || evaluation.outcomes.empty()) return all;
    const std::vector<bool> right = listRight(evaluation);
    Measured worst = all;
    for (std::size_t c = 0; c < trial::kConditions; ++c) {
        for (const bool upper : {false, true}) {
            int trials = 0;
            int successes = 0;
            for (std::size_t i = 0; i < right.size(); ++i) {
                const double at = evaluation.places[i][c];
                // What does not vary is in the middle, and in neither half.
                if (at == 0.5 || (at > 0.5) != upper) continue;
                ++trials;
                successes += right[i] ? 1 : 0;
            }
            if (trials < 2) continue;
            const double share = static_cast<double>(successes) / trials;
            if (share >= worst.value) continue;
            worst = {share, std::sqrt(share * (1.0 - share) / (trials - 1.0))};
        }
    }
    return worst;
}

}  // namespace

Objective worstHalf() {
    Objective objective = successShare();
    objective.key = "worst_half";
    objective.symbol = "Worst half";
    objective.name = "Worst half";
    objective.help = "Success in the half of the operating box where it is least. Higher is better.";
    objective.isDetail = true;
    objective.isSuccess = false;
    objective.applies = [](const Evaluation& evaluation) { return evaluation.isVaried; };
    objective.measure = &measureWorstHalf;
    return objective;
}

}  // namespace trapwright::objectives
