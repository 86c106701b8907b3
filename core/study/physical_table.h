#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/part/stable_poses.h"
#include "core/stats/binomial.h"
#include "core/study/physical_validation.h"
#include "core/study/records.h"

namespace trapwright::study {

/// One side of a row: T, F and how the failed ones failed, and the bounds of the success rate.
struct SuccessCount {
    trial::Tally tally;
    std::optional<double> rate;  // successes over trials; weighted in the weighted total; none: not known
    stats::Interval bounds;      // 95 %, Clopper and Pearson's; of the weighted total profile limits
};

struct PhysicalRow {
    std::vector<int> poses;  // alike ones, rising; empty: a total
    double weight = 0.0;     // how often parts land so
    SuccessCount simulated;
    SuccessCount physical;
    bool weighted = false;    // the weighted total
    int planned = 0;          // physical trials
    std::optional<double> p;  // of the exact test; none without trials on either side
};

/// The paper's Tables 2 and 3: simulated and physical side by side, alike poses in one row. What differs in
/// the rows of poses is tested by Boschloo's test and adjusted for the number of poses (Holm); in the total
/// by Fisher's with the poses as strata, so that it holds before every pose has its share of the trials. One
/// pose alone has Boschloo's in the total too.
struct PhysicalTable {
    std::vector<PhysicalRow> rows;  // poses of the plan, in the order of the part's groups
    PhysicalRow total;              // all trials alike; simulated: of these poses
    PhysicalRow weighted;           // the same trials, rates weighted by how often parts land so
    FeederCount feeders;            // that made the physical trials
    std::string notice;             // feederNotice: to be said before any number
    std::string verdict;            // whether the two differ, in a few sentences
    std::string summary;            // the same in a line, rates weighted where they are known to be
};

/// Without `simulated` that side has no trials. `groups` are the part's (weighPoseGroups); a pose that none
/// of them has stands for itself, with no weight. Takes milliseconds for 1000 simulated trials per pose.
PhysicalTable comparePhysical(const ValidationRecord* simulated, const PhysicalValidation& physical,
                              std::span<const part::PoseGroup> groups);

/// The newest simulated validation of the individual that was printed; null if there is none.
const ValidationRecord* findSimulated(std::span<const ValidationRecord> validations,
                                      const IndividualId& printed);

/// How this track's parts are to end: what its newest simulated validation counted as success, else the
/// newest selection that it was in, else what the settings want (findWanted); none if nothing tells.
std::optional<trial::Goal> findExpected(std::span<const ValidationRecord> validations,
                                        std::span<const SelectionRecord> selections,
                                        const IndividualId& individual,
                                        const std::optional<trial::Goal>& wanted);

/// As text, poses counted from 1; bounds by Clopper and Pearson. The verdict is the last line, the notice, if
/// there is one, the first.
std::string formatPhysical(const PhysicalTable& table);
/// As CSV (RFC 4180, lines end with \n), numbers in full. The last column tells the feeder: "real",
/// "unconnected", "virtual", "unknown", or "mixed".
std::string physicalTableCsv(const PhysicalTable& table);
/// Every trial, one line each, as CSV.
std::string physicalTrialsCsv(const PhysicalValidation& physical);

}  // namespace trapwright::study
