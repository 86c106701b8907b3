#include "core/objectives/success_share.h"

#include <cmath>

namespace trapwright::objectives {

namespace {

int countOriented(const Evaluation& evaluation) {
    const base::Quaternion expected =
        evaluation.expected ? *evaluation.expected
                            : trial::findModalOrientation(trial::finalOrientations(evaluation.outcomes),
                                                          *evaluation.symmetry, evaluation.tolerance);
    return trial::tally(evaluation.outcomes, expected, *evaluation.symmetry, evaluation.tolerance).success;
}

Measured measureSuccess(const Evaluation& evaluation) {
    if (evaluation.outcomes.empty()) return {};
    const int oriented = evaluation.oriented ? *evaluation.oriented : countOriented(evaluation);
    const auto parts = static_cast<double>(trial::countParts(evaluation.outcomes));
    const double share = oriented / parts;
    return {share, parts < 2.0 ? 0.0 : std::sqrt(share * (1.0 - share) / (parts - 1.0))};
}

}  // namespace

Objective successShare() {
    Objective objective;
    objective.key = "success";
    objective.symbol = "Success";
    objective.name = "Success";
    objective.unit = "%";
    objective.help = "Parts that finish in the expected orientation, of all trials. Higher is better.";
    objective.shownAs = 100.0;
    objective.decimals = 1;
    objective.usesTolerance = true;
    objective.measure = &measureSuccess;
    objective.attainable = [](const part::SymmetryGroup&, trial::OrientationDistance) { return 1.0; };
    return objective;
}

}  // namespace trapwright::objectives
