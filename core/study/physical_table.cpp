#include "core/study/physical_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/base/csv.h"
#include "core/stats/binomial.h"
#include "core/stats/rates.h"
#include "core/stats/stratified.h"

namespace trapwright::study {

namespace {

constexpr double kPercent = 100.0;
constexpr double kMillimetre = 1e3;
constexpr double kLevel = 0.05;

void setBounds(SuccessCount& count) {
    count.bounds = stats::calcClopperPearson(count.tally.success, count.tally.trials());
    if (count.tally.trials() > 0)
        count.rate = static_cast<double>(count.tally.success) / count.tally.trials();
}

bool has(const std::vector<int>& poses, int pose) {
    return std::find(poses.begin(), poses.end(), pose) != poses.end();
}

stats::RatePair pairOf(const PhysicalRow& row) {
    return {{row.simulated.tally.success, row.simulated.tally.trials()},
            {row.physical.tally.success, row.physical.tally.trials()}};
}

bool isCompared(const PhysicalRow& row) {
    return row.simulated.tally.trials() > 0 && row.physical.tally.trials() > 0;
}

/// The poses of the plan, alike ones together; without those that the plan leaves out altogether.
std::vector<PhysicalRow> makeRows(const PhysicalPlan& plan, std::span<const part::PoseGroup> groups) {
    std::vector<PhysicalRow> rows;
    const auto addRow = [&](const std::vector<int>& poses, double weight) {
        const auto planned =
            std::count_if(plan.poses.begin(), plan.poses.end(), [&](int pose) { return has(poses, pose); });
        if (planned == 0) return;
        PhysicalRow& row = rows.emplace_back();
        row.poses = poses;
        row.weight = weight;
        row.planned = static_cast<int>(planned) * plan.repetitions;
    };
    for (const part::PoseGroup& group : groups)
        addRow(group.poses, group.probability);
    std::vector<int> strangers;
    for (const int pose : plan.poses) {
        const bool known = std::any_of(groups.begin(), groups.end(),
                                       [&](const part::PoseGroup& group) { return has(group.poses, pose); });
        if (!known) strangers.push_back(pose);
    }
    std::sort(strangers.begin(), strangers.end());
    for (const int pose : strangers)
        addRow({pose}, 0.0);
    return rows;
}

void countTrials(PhysicalRow& row, const ValidationRecord* simulated, const PhysicalValidation& physical) {
    if (simulated != nullptr) {
        for (const ValidationRow& other : simulated->rows)
            if (has(row.poses, other.pose)) row.simulated.tally += other.tally;
    }
    for (const PhysicalTrial& trial : physical.trials)
        if (has(row.poses, trial.pose)) row.physical.tally.add(trial.outcome);
}

/// The total's counts with weighted rates.
void weigh(PhysicalTable& table) {
    table.weighted = table.total;
    table.weighted.weighted = true;
    for (SuccessCount PhysicalRow::*side : {&PhysicalRow::simulated, &PhysicalRow::physical}) {
        std::vector<stats::Stratum> strata;
        for (const PhysicalRow& row : table.rows)
            strata.push_back({row.weight, {(row.*side).tally.success, (row.*side).tally.trials()}});
        const stats::WeightedRate weighted = stats::estimateWeighted(strata);
        SuccessCount& count = table.weighted.*side;
        count.rate = weighted.rate;
        count.bounds = weighted.interval;
    }
}

/// The tests of the rows of poses, adjusted for their number.
void testPoses(std::vector<PhysicalRow>& rows) {
    std::vector<double> probabilities;
    for (const PhysicalRow& row : rows)
        if (isCompared(row)) probabilities.push_back(stats::testBoschloo(pairOf(row)));
    const std::vector<double> adjusted = stats::adjustHolm(probabilities);
    auto next = adjusted.begin();
    for (PhysicalRow& row : rows)
        if (isCompared(row)) row.p = *next++;
}

void testTotal(PhysicalTable& table) {
    std::vector<stats::RatePair> compared;
    for (const PhysicalRow& row : table.rows)
        if (isCompared(row)) compared.push_back(pairOf(row));
    if (compared.empty()) return;
    table.total.p =
        compared.size() == 1 ? stats::testBoschloo(compared.front()) : stats::testFisher(compared);
}

/// Of 1, with as many digits as tell something: "0.046", "less than 0.001".
std::string probabilityText(double p) {
    return p < 0.001 ? "less than 0.001" : fmt::format("{:.3f}", p);
}

std::string shareText(const SuccessCount& count) {
    if (!count.rate) return "-";
    return fmt::format("{:.{}f} %", kPercent * *count.rate, stats::countPercentDecimals(*count.rate));
}

/// Which way the compared poses differ, whatever share of the trials each of them has: above 0 if parts do
/// better on the feeder.
double calcDirection(const PhysicalTable& table) {
    double sum = 0.0;
    for (const PhysicalRow& row : table.rows) {
        if (!isCompared(row)) continue;
        const double simulated =
            static_cast<double>(row.simulated.tally.success) / row.simulated.tally.trials();
        const double physical = static_cast<double>(row.physical.tally.success) / row.physical.tally.trials();
        sum += (physical - simulated) * row.physical.tally.trials();
    }
    return sum;
}

/// One word for the column of a file.
std::string feederWord(const FeederCount& feeders) {
    std::string word;
    for (const auto& [count, kind] : {std::pair(feeders.real, FeederKind::real),
                                      {feeders.unconnected, FeederKind::unconnected},
                                      {feeders.virtualFeeder, FeederKind::virtualFeeder},
                                      {feeders.unknown, FeederKind::unknown}}) {
        if (count == 0) continue;
        if (!word.empty()) return "mixed";
        word = nameOf(kind);
    }
    return word;
}

std::string describe(const PhysicalTable& table) {
    const PhysicalRow& total = table.total;
    if (total.physical.tally.trials() == 0) return "No part has been placed on the feeder yet.";
    const bool trained = table.feeders.virtualFeeder > 0 && !table.feeders.mixed();
    std::string feeder =
        fmt::format("{} of {} parts succeeded on the {} ({}; 95 % Clopper-Pearson {:.1f} to {:.1f} %).",
                    total.physical.tally.success, total.physical.tally.trials(),
                    trained ? "virtual feeder" : "feeder", shareText(total.physical),
                    kPercent * total.physical.bounds.low, kPercent * total.physical.bounds.high);
    if (const SuccessCount& weighted = table.weighted.physical; weighted.rate && table.rows.size() > 1) {
        feeder +=
            fmt::format(" Weighted by how often parts land so that is {} ({:.1f} to {:.1f} %).",
                        shareText(weighted), kPercent * weighted.bounds.low, kPercent * weighted.bounds.high);
    }
    if (!total.p)
        return feeder + " This track has not been validated in simulation, so there is nothing to compare.";

    std::string poses;
    for (const PhysicalRow& row : table.rows)
        if (row.p && *row.p < kLevel)
            poses += fmt::format("{}{}", poses.empty() ? "" : ", ", part::namePoses(row.poses));
    const std::string where =
        poses.empty() ? ""
                      : fmt::format(" Taken by themselves, these poses differ from simulation: {}.", poses);
    if (*total.p >= kLevel) {
        return fmt::format(
            "{} In simulation {} did. These trials show no difference (exact test, p = {}); that is no proof "
            "that there is none.{}",
            feeder, shareText(total.simulated), probabilityText(*total.p), where);
    }
    return fmt::format(
        "{} In simulation {} did. The feeder does {} than simulation: were they alike, so great a difference "
        "would be seen with a probability of {} (exact test).{}",
        feeder, shareText(total.simulated), calcDirection(table) > 0.0 ? "better" : "worse",
        probabilityText(*total.p), where);
}

std::string summarize(const PhysicalTable& table) {
    const PhysicalRow& total = table.total;
    if (total.physical.tally.trials() == 0) return "No part has been placed on the feeder yet.";
    const bool trained = table.feeders.virtualFeeder > 0 && !table.feeders.mixed();
    // Both sides alike: without a pose's trials one of them has no weighted rate.
    const bool weighted =
        table.rows.size() > 1 && table.weighted.physical.rate && (!total.p || table.weighted.simulated.rate);
    const PhysicalRow& shown = weighted ? table.weighted : total;
    std::string text =
        fmt::format("{}{} on the {} ({:.1f} to {:.1f} %)", trained ? "For training: " : "",
                    shareText(shown.physical), trained ? "virtual feeder" : "feeder",
                    kPercent * shown.physical.bounds.low, kPercent * shown.physical.bounds.high);
    if (!total.p) return text + ". Not validated in simulation.";
    text += fmt::format(", {} in simulation{}. ", shareText(shown.simulated), weighted ? ", weighted" : "");
    const std::string p = *total.p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", *total.p);
    if (*total.p >= kLevel) return text + fmt::format("No difference shown ({}).", p);
    // As the test compares them, which may be another way than the totals differ.
    return text + fmt::format("The feeder does {}{} ({}).", calcDirection(table) > 0.0 ? "better" : "worse",
                              table.rows.size() > 1 ? ", pose by pose" : "", p);
}

/// "99.0 %    98.2 ...  99.5 %"
std::string rateText(const SuccessCount& count) {
    if (count.tally.trials() == 0) return fmt::format("{:>8}   {:>20}", "-", "-");
    return fmt::format("{:>8}   {:>8.1f} ... {:>5.1f} %", shareText(count), kPercent * count.bounds.low,
                       kPercent * count.bounds.high);
}

/// "1000      10   99.0 %    98.2 ...  99.5 %"
std::string sideText(const SuccessCount& count) {
    return fmt::format("{:>6} {:>5} {}", count.tally.trials(), count.tally.failures(), rateText(count));
}

void appendText(std::string& text, const std::string& name, const PhysicalRow& row) {
    fmt::format_to(std::back_inserter(text), "{:<15} {:>8} {}   {}   {:>6} {:>6} {:>9}   {:>6}\n", name,
                   row.poses.empty() ? "" : fmt::format("{:.1f} %", kPercent * row.weight),
                   sideText(row.simulated), sideText(row.physical), row.physical.tally.wrongOrientation,
                   row.physical.tally.stuck, row.physical.tally.fellOff,
                   row.p ? (*row.p < 0.001 ? "<0.001" : fmt::format("{:.3f}", *row.p)) : "-");
}

/// "1 2 3": what a spreadsheet does not take for a date.
std::string posesCsv(const std::vector<int>& poses) {
    std::string text;
    for (const int pose : poses)
        text += fmt::format("{}{}", text.empty() ? "" : " ", pose + 1);
    return text;
}

std::string sideCsv(const SuccessCount& count) {
    return fmt::format("{},{},{},{},{},{},{},{}", count.tally.trials(), count.tally.failures(),
                       count.rate ? fmt::format("{}", kPercent * *count.rate) : "",
                       count.tally.wrongOrientation, count.tally.stuck, count.tally.fellOff,
                       kPercent * count.bounds.low, kPercent * count.bounds.high);
}

std::string sideHeadings(const char* side) {
    std::string text;
    for (const char* heading :
         {"trials", "failures", "success_percent", "wrong_orientation", "stuck", "fell_off",
          "clopper_pearson_95_low_percent", "clopper_pearson_95_high_percent"})
        text += fmt::format(",{}_{}", side, heading);
    return text;
}

}  // namespace

PhysicalTable comparePhysical(const ValidationRecord* simulated, const PhysicalValidation& physical,
                              std::span<const part::PoseGroup> groups) {
    PhysicalTable table;
    table.rows = makeRows(physical.plan, groups);
    for (PhysicalRow& row : table.rows) {
        countTrials(row, simulated, physical);
        table.total.simulated.tally += row.simulated.tally;
        table.total.physical.tally += row.physical.tally;
        table.total.planned += row.planned;
        setBounds(row.simulated);
        setBounds(row.physical);
    }
    setBounds(table.total.simulated);
    setBounds(table.total.physical);
    weigh(table);
    testPoses(table.rows);
    testTotal(table);
    table.feeders = countFeeders(physical);
    table.notice = feederNotice(physical);
    table.verdict = describe(table);
    table.summary = summarize(table);
    return table;
}

const ValidationRecord* findSimulated(std::span<const ValidationRecord> validations,
                                      const IndividualId& printed) {
    const ValidationRecord* newest = nullptr;
    for (const ValidationRecord& record : validations)
        if (isSameIndividual(record, printed)) newest = &record;
    return newest;
}

std::optional<trial::Goal> findExpected(std::span<const ValidationRecord> validations,
                                        std::span<const SelectionRecord> selections,
                                        const IndividualId& individual,
                                        const std::optional<trial::Goal>& wanted) {
    if (const ValidationRecord* found = findSimulated(validations, individual)) return found->goal;
    const trial::Goal* newest = wanted ? &*wanted : nullptr;
    for (const SelectionRecord& selection : selections)
        for (const SelectionEntry& entry : selection.entries)
            if (isSameIndividual(entry, individual) && entry.finished > 0) newest = &entry.goal;
    return newest != nullptr ? std::optional(*newest) : std::nullopt;
}

std::string formatPhysical(const PhysicalTable& table) {
    std::string text = table.notice.empty() ? "" : table.notice + "\n";
    text += fmt::format("{:<24} {:^44}   {:^44}   {:^23}\n", "", "Simulation", "Physical", "failed");
    fmt::format_to(
        std::back_inserter(text),
        "{:<15} {:>8} {:>6} {:>5} {:>8}   {:>20}   {:>6} {:>5} {:>8}   {:>20}   {:>6} {:>6} {:>9}   {:>6}\n",
        "Pose", "lands so", "T", "F", "P", "95 % Clopper-Pearson", "T", "F", "P", "95 % Clopper-Pearson",
        "wrong", "stuck", "fell off", "p");
    for (const PhysicalRow& row : table.rows)
        appendText(text, part::namePoses(row.poses), row);
    fmt::format_to(std::back_inserter(text), "{:<37} {}   {:>12} {}\n", "Total, weighted",
                   rateText(table.weighted.simulated), "", rateText(table.weighted.physical));
    appendText(text, "Total, alike", table.total);
    return text + "Weighted by how often parts land so; alike: all trials count the same.\n" + table.verdict +
           "\n";
}

std::string physicalTableCsv(const PhysicalTable& table) {
    std::string text = "poses,lands_so_percent" + sideHeadings("simulated") + sideHeadings("physical") +
                       ",physical_planned,p,feeder\n";
    const auto append = [&](const std::string& name, const PhysicalRow& row) {
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}\n", name,
                       row.poses.empty() ? "" : fmt::format("{}", kPercent * row.weight),
                       sideCsv(row.simulated), sideCsv(row.physical), row.planned,
                       row.p ? fmt::format("{}", *row.p) : "", feederWord(table.feeders));
    };
    for (const PhysicalRow& row : table.rows)
        append(posesCsv(row.poses), row);
    append("total weighted", table.weighted);
    append("total all alike", table.total);
    return text;
}

std::string physicalTrialsCsv(const PhysicalValidation& physical) {
    std::string text =
        "trial,pose,outcome,seconds,set_point_percent,frequency_hz,time_utc,note,feeder,drive,half_stroke_"
        "mm\n";
    for (const PhysicalTrial& trial : physical.trials) {
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{}\n", trial.number + 1,
                       trial.pose + 1, trial::verdictName(trial.outcome), trial.seconds,
                       kPercent * trial.setPoint, trial.frequency, base::csvField(trial.time),
                       base::csvField(trial.note), nameOf(trial.feeder), base::csvField(trial.drive),
                       trial.halfStroke > 0.0 ? fmt::format("{}", kMillimetre * trial.halfStroke) : "");
    }
    return text;
}

}  // namespace trapwright::study
