#include "core/objectives/conveying_speed.h"

#include <numeric>
#include <vector>

#include "core/stats/mean.h"

namespace trapwright::objectives {

namespace {

Measured measureSpeed(const Evaluation& evaluation) {
    std::vector<double> speeds;
    for (const trial::Outcome& outcome : evaluation.outcomes) {
        for (const trial::PartOutcome& part : outcome.parts) {
            if (part.ending != trial::Ending::finished || !(part.time > 0.0)) continue;
            speeds.push_back((part.farthest.position.x() - part.initial.position.x()) / part.time);
        }
    }
    if (speeds.empty()) return {};
    const double sum = std::accumulate(speeds.begin(), speeds.end(), 0.0);
    return {sum / static_cast<double>(speeds.size()), stats::calcStandardError(speeds)};
}

}  // namespace

Objective conveyingSpeed() {
    constexpr double kMillimetresPerMetre = 1000.0;
    Objective objective;
    objective.key = "conveying_speed";
    objective.symbol = "Speed";
    objective.name = "Conveying speed";
    objective.unit = "mm/s";
    objective.help =
        "Mean speed along the track of the parts that finish, from where they start. Higher is better.";
    objective.shownAs = kMillimetresPerMetre;
    objective.decimals = 1;
    objective.measure = &measureSpeed;
    return objective;
}

}  // namespace trapwright::objectives
