#include "core/objectives/success_share.h"

#include <cmath>

namespace trapwright::objectives {

namespace {

trial::Tally countVerdicts(const Evaluation& evaluation) {
    const base::Quaternion expected =
        evaluation.expected ? *evaluation.expected
                            : trial::findModalOrientation(trial::finalOrientations(evaluation.outcomes),
                                                          *evaluation.symmetry, evaluation.tolerance);
    return trial::tally(evaluation.outcomes, expected, *evaluation.symmetry, evaluation.tolerance);
}

Measured measureShare(int count, double of) {
    if (of < 1.0) return {};
    const double share = count / of;
    return {share, of < 2.0 ? 0.0 : std::sqrt(share * (1.0 - share) / (of - 1.0))};
}

Measured measureSuccess(const Evaluation& evaluation) {
    if (evaluation.outcomes.empty()) return {};
    const int oriented = evaluation.oriented ? *evaluation.oriented : countVerdicts(evaluation).success;
    return measureShare(oriented, static_cast<double>(trial::countParts(evaluation.outcomes)));
}

Measured measureCorrect(const Evaluation& evaluation) {
    const std::size_t finished = trial::finalOrientations(evaluation.outcomes).size();
    if (finished == 0) return {};
    const int oriented = evaluation.oriented ? *evaluation.oriented : countVerdicts(evaluation).success;
    return measureShare(oriented, static_cast<double>(finished));
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

Objective correctShare() {
    Objective objective = successShare();
    objective.key = "correct";
    objective.symbol = "Correct";
    objective.name = "Correct";
    objective.help = "Parts in the expected orientation, of those that finish. Higher is better.";
    objective.measure = &measureCorrect;
    return objective;
}

}  // namespace trapwright::objectives
