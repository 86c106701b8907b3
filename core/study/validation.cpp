#include "core/study/validation.h"

#include <algorithm>
#include <limits>

#include "core/study/target.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

namespace {

std::vector<ValidationGroup> groupRows(const ValidationRecord& record,
                                       std::span<const part::PoseGroup> groups) {
    std::vector<ValidationGroup> grouped;
    for (const part::PoseGroup& group : groups)
        grouped.push_back({group.poses, group.probability, {}, {}});
    for (const ValidationRow& row : record.rows) {
        auto own = std::find_if(grouped.begin(), grouped.end(), [&](const ValidationGroup& group) {
            return std::find(group.poses.begin(), group.poses.end(), row.pose) != group.poses.end();
        });
        if (own == grouped.end()) own = grouped.insert(own, {{row.pose}, 0.0, {}, {}});
        own->sum.pose = own->poses.front();
        own->rows.push_back(row);
        own->sum.tally += row.tally;
    }
    std::erase_if(grouped, [](const ValidationGroup& group) { return group.rows.empty(); });
    return grouped;
}

std::vector<stats::ArrivalStratum> strataOf(std::span<const ValidationGroup> groups) {
    std::vector<stats::ArrivalStratum> strata;
    strata.reserve(groups.size());
    for (const ValidationGroup& group : groups) {
        const trial::Tally& tally = group.sum.tally;
        strata.push_back({group.weight, tally.trials(), tally.finished(), tally.success});
    }
    return strata;
}

}  // namespace

base::Result<ValidationRecord> validate(const StudyInputs& inputs, const Individual& individual,
                                        const std::optional<trial::Goal>& given, base::RunControl control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    const Settings& settings = inputs.settings;
    const int poses = static_cast<int>(inputs.part->stablePoses.size());
    const int trials = settings.validation.trialsPerPose;
    if (poses == 0) {
        return base::Error{"The part " + inputs.part->name +
                           " has no stable poses to start from, so it cannot be validated."};
    }
    if (std::int64_t{poses} * trials > std::numeric_limits<int>::max()) {
        return base::Error{"validation.trialsPerPose is " + std::to_string(trials) + "; for a part with " +
                           std::to_string(poses) + " stable poses that is too many. Set it lower."};
    }
    auto built = decodeTrack(settings.track, individual.record.design);
    if (!built) return built.error();
    const TrialScene scene =
        makeScene(settings, inputs.part, std::make_shared<const track::Track>(std::move(built).value()));
    std::vector<trial::TrialBatch> batches;
    batches.reserve(static_cast<std::size_t>(poses));
    for (int pose = 0; pose < poses; ++pose) {
        batches.push_back(makeValidationBatch(scene, individual, pose, trials));
    }
    const auto outcomes = runTrials(*inputs.engine, batches, std::move(control));
    if (!outcomes) return outcomes.error();

    ValidationRecord record;
    record.generation = individual.generation;
    record.individual = individual.individual;
    record.engine = inputs.engine->name();
    record.box = boxOfJudging(settings);
    record.tolerance = settings.validation.tolerance;
    record.made.maker = makerOf(*inputs.engine);
    for (const std::vector<trial::Outcome>& own : *outcomes)
        record.made.outcomes.insert(record.made.outcomes.end(), own.begin(), own.end());
    record.goal = trial::findGoal(given ? given : findWanted(settings, *inputs.part), record.made.outcomes,
                                  inputs.part->symmetry, record.tolerance);
    for (int pose = 0; pose < poses; ++pose) {
        const std::vector<trial::Outcome>& own = (*outcomes)[static_cast<std::size_t>(pose)];
        record.rows.push_back(
            {pose, trial::tally(own, record.goal, inputs.part->symmetry, record.tolerance)});
    }
    return record;
}

ValidationRow calcTotal(const ValidationRecord& record) {
    ValidationRow total;
    total.pose = -1;
    for (const ValidationRow& row : record.rows)
        total.tally += row.tally;
    return total;
}

std::vector<stats::ArrivalStratum> listStrata(const ValidationRecord& record,
                                              std::span<const part::PoseGroup> groups) {
    return strataOf(groupRows(record, groups));
}

ValidationTable tabulate(const ValidationRecord& record, std::span<const part::PoseGroup> groups) {
    ValidationTable table;
    table.groups = groupRows(record, groups);
    table.total = calcTotal(record);
    const std::vector<stats::ArrivalStratum> strata = strataOf(table.groups);
    table.weighted = stats::estimateWeighted(stats::countRight(strata));
    if (table.total.tally.fellOff > 0) table.correct = stats::estimateCorrect(strata);
    return table;
}

}  // namespace trapwright::study
