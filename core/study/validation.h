#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/part/stable_poses.h"
#include "core/stats/stratified.h"
#include "core/study/evaluator.h"
#include "core/study/records.h"

namespace trapwright::study {

/// The paper's Tables 2 and 3 for one individual (section 6.2; decisions.md#selection-and-success): trials
/// that start near each of the part's stable poses with a random heading. What counts as success is what is
/// given, or else what the settings want, or else the mode of all final orientations. Errors: settings or
/// part that cannot be used, a part without stable poses, genes, engine, cancelled.
base::Result<ValidationRecord> validate(const StudyInputs& inputs, const Individual& individual,
                                        const std::optional<trial::Goal>& given, base::RunControl control);

/// The sums of all rows, all trials alike; its pose is -1.
ValidationRow calcTotal(const ValidationRecord& record);

/// The trials that started in poses which are alike.
struct ValidationGroup {
    std::vector<int> poses;  // all alike ones, rising, tried or not
    double weight = 0.0;     // how often parts land so
    ValidationRow sum;       // its pose is the first one
    std::vector<ValidationRow> rows;
};

/// A validation as people read it.
struct ValidationTable {
    std::vector<ValidationGroup> groups;  // in the order of the part's groups
    ValidationRow total;                  // all trials alike
    stats::WeightedRate weighted;         // success, weighted by how often parts land so
    stats::WeightedRate correct;          // of those that arrive, weighted alike; where parts fall off alone
};

/// What became of each group of poses, as they are weighted. `groups` as of tabulate().
std::vector<stats::ArrivalStratum> listStrata(const ValidationRecord& record,
                                              std::span<const part::PoseGroup> groups);

/// `groups` are the part's (weighPoseGroups); a pose that none of them has stands for itself, with no weight.
ValidationTable tabulate(const ValidationRecord& record, std::span<const part::PoseGroup> groups);

}  // namespace trapwright::study
