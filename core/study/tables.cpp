#include "core/study/tables.h"

#include <fmt/format.h>

#include <iterator>

#include "core/stats/binomial.h"
#include "core/study/validation.h"

namespace trapwright::study {

namespace {

constexpr double kPercent = 100.0;

/// "99.4 %   98.7 ... 99.8 %"
std::string shareText(int successes, int trials) {
    if (trials == 0) return fmt::format("{:>7}   {:>20}", "-", "-");
    const stats::Interval bounds = stats::calcClopperPearson(successes, trials);
    return fmt::format("{:5.1f} %   {:>8.1f} ... {:5.1f} %", kPercent * successes / trials,
                       kPercent * bounds.low, kPercent * bounds.high);
}

void appendRow(std::string& text, const std::string& name, const ValidationRow& row) {
    fmt::format_to(std::back_inserter(text), "{:<5} {:>7} {:>7}   {}   {:>6} {:>6} {:>9}\n", name, row.trials,
                   row.failures, shareText(row.trials - row.failures, row.trials), row.wrongOrientation,
                   row.stuck, row.fellOff);
}

}  // namespace

std::string formatValidation(const ValidationRecord& record) {
    std::string text = fmt::format("{:<5} {:>7} {:>7}   {:>7}   {:>20}   {:>6} {:>6} {:>9}\n", "Pose", "T",
                                   "F", "P", "95 % Clopper-Pearson", "wrong", "stuck", "fell off");
    for (const ValidationRow& row : record.rows)
        appendRow(text, std::to_string(row.pose + 1), row);
    appendRow(text, "Total", calcTotal(record));
    return text;
}

std::string formatSelection(const SelectionRecord& record) {
    std::string text =
        fmt::format("{:>4} {:>10} {:>10} {:>8} {:>8} {:>9} {:>7}   {:>7}   {:>20}\n", "Rank", "Generation",
                    "Individual", "F_D", "F_O", "Finished", "Trials", "Success", "95 % Clopper-Pearson");
    int rank = 0;
    for (const SelectionEntry& entry : record.entries) {
        fmt::format_to(std::back_inserter(text), "{:>4} {:>10} {:>10} {:>8.3f} {:>8.3f} {:>9} {:>7}   {}\n",
                       ++rank, entry.generation, entry.individual, entry.fitness.distance,
                       entry.fitness.orientation, entry.finished, entry.trials,
                       shareText(entry.oriented, entry.trials));
    }
    return text;
}

}  // namespace trapwright::study
