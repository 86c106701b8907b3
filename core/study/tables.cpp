#include "core/study/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/stats/binomial.h"

namespace trapwright::study {

namespace {

constexpr double kPercent = 100.0;

/// "99.4 %   98.7 ... 99.8 %"
std::string shareText(double share, const stats::Interval& bounds) {
    return fmt::format("{:5.{}f} %   {:>8.1f} ... {:5.1f} %", kPercent * share,
                       stats::countPercentDecimals(share), kPercent * bounds.low, kPercent * bounds.high);
}

std::string shareText(int successes, int trials) {
    if (trials == 0) return fmt::format("{:>7}   {:>20}", "-", "-");
    return shareText(static_cast<double>(successes) / trials, stats::calcClopperPearson(successes, trials));
}

void appendRow(std::string& text, const std::string& name, const std::string& weight,
               const ValidationRow& row) {
    const trial::Tally& tally = row.tally;
    fmt::format_to(std::back_inserter(text), "{:<15} {:>8} {:>7} {:>7}   {}   {:>6} {:>6} {:>9}\n", name,
                   weight, tally.trials(), tally.failures(), shareText(tally.success, tally.trials()),
                   tally.wrongOrientation, tally.stuck, tally.fellOff);
}

}  // namespace

std::string formatValidation(const ValidationTable& table, bool everyPose) {
    std::string text =
        fmt::format("{:<15} {:>8} {:>7} {:>7}   {:>7}   {:>20}   {:>6} {:>6} {:>9}\n", "Pose", "lands so",
                    "T", "F", "P", "95 % Clopper-Pearson", "wrong", "stuck", "fell off");
    for (const ValidationGroup& group : table.groups) {
        appendRow(text, part::namePoses(group.poses), fmt::format("{:.1f} %", kPercent * group.weight),
                  group.sum);
        if (!everyPose || group.rows.size() < 2) continue;
        for (const ValidationRow& row : group.rows)
            appendRow(text, fmt::format("  {}", row.pose + 1), "", row);
    }
    const auto appendShare = [&](const char* name, const stats::WeightedRate& weighted) {
        if (!weighted.rate) return;
        fmt::format_to(std::back_inserter(text), "{:<15} {:>8} {:>7} {:>7}   {}   {:>23}\n", name, "", "", "",
                       shareText(*weighted.rate, weighted.interval), "");
    };
    appendShare("Total, weighted", table.weighted);
    appendShare("Correct", table.correct);
    appendRow(text, "Total, alike", "", table.total);
    text += "Weighted by how often parts land so; alike: all trials count the same.\n";
    if (table.correct.rate) text += "Correct: of those that arrive, weighted likewise.\n";
    return text;
}

std::string formatSelection(const SelectionRecord& record) {
    // What trials tell and has no column of its own.
    objectives::ObjectiveList objectives;
    for (const objectives::Objective& objective : objectives::allObjectives()) {
        const bool isScored = !record.entries.empty() &&
                              objectives::findScore(record.entries.front().fitness, objective.key) != nullptr;
        if (isScored && objective.isNoisy && !objective.isSuccess) objectives.push_back(&objective);
    }
    std::string text = fmt::format("{:>4} {:>10} {:>10}", "Rank", "Generation", "Individual");
    std::vector<std::size_t> widths;
    for (const objectives::Objective* objective : objectives) {
        const std::string title =
            objective->key == objective->symbol ? std::string(objective->symbol) : objective->title();
        constexpr std::size_t kLeast = 8;
        widths.push_back(std::max(kLeast, title.size()));
        text += fmt::format(" {:>{}}", title, widths.back());
    }
    text +=
        fmt::format(" {:>9} {:>7}   {:>7}   {:>20}", "Finished", "Trials", "Success", "95 % Clopper-Pearson");
    const bool hasCorners = std::ranges::any_of(
        record.entries, [](const SelectionEntry& entry) { return entry.corners.trials > 0; });
    text += hasCorners ? fmt::format("   {:>7}   {:>20}\n", "Corners", "95 % Clopper-Pearson") : "\n";
    int rank = 0;
    for (const SelectionEntry& entry : record.entries) {
        text += fmt::format("{:>4} {:>10} {:>10}", ++rank, entry.generation, entry.individual);
        for (std::size_t i = 0; i < objectives.size(); ++i) {
            const objectives::Score* score = objectives::findScore(entry.fitness, objectives[i]->key);
            text += fmt::format(" {:>{}}",
                                score != nullptr ? objectives::shown(*objectives[i], score->value) : "-",
                                widths[i]);
        }
        text += fmt::format(" {:>9} {:>7}   {}", entry.finished, entry.trials,
                            shareText(entry.oriented, entry.trials));
        if (hasCorners) text += "   " + shareText(entry.corners.successes, entry.corners.trials);
        text += '\n';
    }
    return text;
}

}  // namespace trapwright::study
