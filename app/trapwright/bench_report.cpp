#include "app/trapwright/bench_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/trapwright/json_records.h"

namespace trapwright::app {

namespace {

constexpr const char* kColumns = "{:<15} {:<12} {:>7} {:>14} {:>8} {:>9} {:>12} {:>9} {:>9}   {}\n";

std::string describeShares(const trial::Costs& costs) {
    const double total = costs.total();
    if (total <= 0.0) return "not told";
    return fmt::format("{:>3.0f} {:>3.0f} {:>3.0f} %", 100.0 * costs.detection / total,
                       100.0 * costs.law / total, 100.0 * costs.integration / total);
}

nlohmann::ordered_json sharesToJson(const trial::Costs& costs) {
    const double total = costs.total();
    if (total <= 0.0) return nullptr;
    return {{"detection", costs.detection / total},
            {"law", costs.law / total},
            {"integration", costs.integration / total}};
}

}  // namespace

std::string benchHeader(const bench::Plan& plan) {
    return fmt::format(
               "{} trials a scene, median of {} repeats in turns, one thread, CPU time of the process\n",
               plan.trials, plan.repeats) +
           fmt::format(kColumns, "Scene", "Engine", "Step ms", "Trials/s core", "us/step", "Steps",
                       "To the first", "Finished", "Success", "Detection, law, integration");
}

std::string benchRow(const std::string& scene, const bench::Measurement& measured) {
    if (!measured.problem.empty())
        return fmt::format("{:<15} {:<12} cannot: {}\n", scene, measured.engine, measured.problem);
    const study::TrialCounts& counts = measured.counts;
    return fmt::format(kColumns, scene, measured.engine, fmt::format("{:g}", 1e3 * measured.step),
                       fmt::format("{:.1f}", 1.0 / measured.secondsPerTrial()),
                       fmt::format("{:.3f}", 1e6 * measured.secondsPerStep()),
                       fmt::format("{:.0f}", measured.stepsPerTrial()),
                       fmt::format("{:.2f} x", measured.ratio),
                       fmt::format("{:.1f} %", 100.0 * counts.tally.finished() / counts.tally.trials()),
                       fmt::format("{:.1f} %", 100.0 * counts.tally.success / counts.tally.trials()),
                       describeShares(measured.costs));
}

nlohmann::ordered_json benchRowToJson(const std::string& scene, const bench::Measurement& measured) {
    nlohmann::ordered_json row = {{"scene", scene}, {"engine", measured.engine}};
    if (!measured.problem.empty()) {
        row["problem"] = measured.problem;
        return row;
    }
    const study::TrialCounts& counts = measured.counts;
    row.update({{"step_ms", 1e3 * measured.step},
                {"trials", counts.tally.trials()},
                {"trials_per_second_per_core", 1.0 / measured.secondsPerTrial()},
                {"cpu_seconds_per_trial", measured.secondsPerTrial()},
                {"cpu_microseconds_per_step", 1e6 * measured.secondsPerStep()},
                {"steps_per_trial", measured.stepsPerTrial()},
                {"ratio_to_first", measured.ratio},
                {"cpu_seconds", measured.cpuSeconds},
                {"finished", shareToJson(counts.tally.finished(), counts.tally.trials())},
                {"oriented", shareToJson(counts.tally.success, counts.tally.trials())},
                {"shares", sharesToJson(measured.costs)}});
    return row;
}

}  // namespace trapwright::app
