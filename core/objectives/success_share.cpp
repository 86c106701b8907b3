#include "core/objectives/success_share.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/objectives/objectives.h"
#include "core/trial/returns.h"

namespace trapwright::objectives {

namespace {

trial::Goal findGoal(const Evaluation& evaluation) {
    return trial::findGoal(evaluation.wanted, evaluation.outcomes, *evaluation.symmetry,
                           evaluation.tolerance);
}

trial::Tally countVerdicts(const Evaluation& evaluation) {
    return trial::tally(evaluation.outcomes, findGoal(evaluation), *evaluation.symmetry,
                        evaluation.tolerance);
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

int countReturned(const Evaluation& evaluation) {
    int count = 0;
    for (const trial::Outcome& outcome : evaluation.outcomes)
        for (const trial::PartOutcome& part : outcome.parts)
            count += trial::comesAgain(part, *evaluation.track, evaluation.returns) ? 1 : 0;
    return count;
}

/// Of a share by Laplace's rule of succession, which is never 0 or 1: how many tenfolds it is from all.
Measured measureDecades(double count, double of) {
    const double share = (count + 1.0) / (of + 2.0);
    return {std::log10(share), std::sqrt((1.0 - share) / (share * (of + 2.0))) / std::log(10.0)};
}

Measured measurePurity(const Evaluation& evaluation) {
    if (evaluation.outcomes.empty()) return {};
    const trial::Tally tally = countVerdicts(evaluation);
    const double parts = tally.trials() - countReturned(evaluation);
    const Measured wrong = measureDecades(parts - tally.success, parts);
    return {-wrong.value, wrong.error};
}

Measured measureYield(const Evaluation& evaluation) {
    constexpr double kLeast = -8.0;  // less than any number of trials tells
    if (evaluation.outcomes.empty()) return {kLeast};
    const trial::Tally tally = countVerdicts(evaluation);
    return measureDecades(tally.success, tally.trials());
}

Measured measureThroughput(const Evaluation& evaluation) {
    if (!evaluation.streams) return {};
    return measureShare(evaluation.streams->successes, evaluation.streams->trials);
}

Measured measureSorting(const Evaluation& evaluation) {
    // What a track has on which nothing finishes: more than parts that end at random ever have.
    constexpr double kMostBits = 8.0;
    const trial::Tally tally = countVerdicts(evaluation);
    const double parts = tally.trials();
    const double staying = parts - countReturned(evaluation);
    if (staying < 2.0) return {kMostBits};
    const double itself = evaluation.wanted ? 0.0 : 1.0;
    const double of = staying - itself;
    const double share = std::max(0.0, (tally.success - itself) / of);
    const double least = std::exp2(-kMostBits);
    const double right = least + (1.0 - least) * share;
    const double error = std::sqrt(share * (1.0 - share) / of) / right;
    const double errorOfStaying = kBitsOfHalving * std::sqrt((1.0 - staying / parts) / staying);
    return {-std::log2(right) - kBitsOfHalving * std::log2(staying / parts),
            std::hypot(error, errorOfStaying) / std::log(2.0)};
}

}  // namespace

Measured measureShare(int count, double of) {
    if (of < 1.0) return {};
    const double share = count / of;
    return {share, of < 2.0 ? 0.0 : std::sqrt(share * (1.0 - share) / (of - 1.0))};
}

int countSuccess(const Evaluation& evaluation) {
    return countVerdicts(evaluation).success;
}

std::vector<bool> listRight(const Evaluation& evaluation) {
    const trial::Goal goal = findGoal(evaluation);
    std::vector<bool> right;
    right.reserve(evaluation.outcomes.size());
    for (const trial::Outcome& outcome : evaluation.outcomes)
        right.push_back(std::ranges::all_of(outcome.parts, [&](const trial::PartOutcome& part) {
            return trial::judge(part, goal, *evaluation.symmetry, evaluation.tolerance) ==
                   trial::Verdict::success;
        }));
    return right;
}

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
    objective.isSuccess = true;
    objective.measure = &measureSuccess;
    objective.attainable = [](const Task&) { return 1.0; };
    return objective;
}

Objective wanted() {
    Objective objective = successShare();
    objective.key = objective.symbol = kWanted;
    objective.name = "Wanted";
    objective.help = "Parts that finish as they are wanted, of all trials. Higher is better.";
    objective.isDetail = true;
    objective.needsWanted = true;
    objective.measure = [](const Evaluation& evaluation) {
        assert(evaluation.wanted);
        return successShare().measure(evaluation);
    };
    return objective;
}

Objective correctShare() {
    Objective objective = successShare();
    objective.key = "correct";
    objective.symbol = "Correct";
    objective.name = "Correct";
    objective.help = "Parts in the expected orientation, of those that finish. Higher is better.";
    objective.isSuccess = false;
    objective.measure = &measureCorrect;
    return objective;
}

Objective sorting() {
    Objective objective;
    objective.key = "sorting";
    objective.symbol = "Sorting";
    objective.name = "Sorting";
    objective.unit = "bit";
    objective.help =
        "How many times the share of right parts, of those that do not come again, has to double to be all, "
        "and a sixth of a bit for each halving of their number. Lower is better.";
    objective.decimals = 2;
    objective.moreIsBetter = false;
    objective.usesTolerance = true;
    objective.measure = &measureSorting;
    objective.attainable = [](const Task&) { return 0.0; };
    return objective;
}

Objective purity() {
    Objective objective;
    objective.key = kPurity;
    objective.symbol = "Purity";
    objective.name = "Purity";
    objective.unit = "nines";
    objective.help =
        "How few of the parts that do not come again are wrong: 2 are 99 % right, 3 are 99.9 %. Limited by "
        "how many parts are tried. Higher is better.";
    objective.decimals = 2;
    objective.isDetail = true;
    objective.usesTolerance = true;
    objective.applies = [](const Evaluation& evaluation) {
        return evaluation.returns != trial::Returns::nowhere;
    };
    objective.measure = &measurePurity;
    return objective;
}

Objective yield() {
    Objective objective = purity();
    objective.key = kYield;
    objective.symbol = "Yield";
    objective.name = "Yield";
    objective.unit = "decades";
    objective.help =
        "The share of right parts, of all that are fed, by its decimal logarithm: -1 is a tenth of them, "
        "-0.3 half of them. Higher is better.";
    objective.measure = &measureYield;
    objective.attainable = [](const Task&) { return 0.0; };
    return objective;
}

Objective throughput() {
    Objective objective = successShare();
    objective.key = kThroughput;
    objective.symbol = "Throughput";
    objective.name = "Throughput";
    objective.help =
        "Parts of streams that leave the track as wanted, of those that come to it. Higher is better.";
    objective.isDetail = true;
    objective.isSuccess = false;
    objective.applies = [](const Evaluation& evaluation) { return evaluation.streams.has_value(); };
    objective.measure = &measureThroughput;
    return objective;
}

}  // namespace trapwright::objectives
