#include "core/objectives/worst_case.h"

#include <algorithm>
#include <vector>

#include "core/objectives/objectives.h"
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
            const Measured half = measureShare(successes, trials);
            if (half.value < worst.value) worst = half;
        }
    }
    return worst;
}

Measured measureCorners(const Evaluation& evaluation) {
    if (evaluation.corners) return measureShare(evaluation.corners->successes, evaluation.corners->trials);
    const std::vector<bool> right = listRight(evaluation);
    int trials = 0;
    int successes = 0;
    for (std::size_t i = 0; i < evaluation.places.size(); ++i) {
        if (!trial::isCorner(evaluation.places[i])) continue;
        ++trials;
        successes += right[i] ? 1 : 0;
    }
    if (trials == 0) return {};
    return measureShare(successes, trials);
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

Objective corners() {
    Objective objective = worstHalf();
    objective.key = kCorners;
    objective.symbol = "Corners";
    objective.name = "Corners";
    objective.help = "Success of the trials in corners of the operating box. Higher is better.";
    objective.applies = [](const Evaluation& evaluation) { return evaluation.hasCorners; };
    objective.measure = &measureCorners;
    return objective;
}

}  // namespace trapwright::objectives
