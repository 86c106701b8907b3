#include "app/trapwright/engine_agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/trapwright/json_records.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/stats/binomial.h"
#include "core/study/presets.h"
#include "core/track/track_file.h"
#include "core/verify/agreement.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

std::string formatShare(int count, int trials) {
    const stats::Interval bounds = stats::calcClopperPearson(count, trials);
    return fmt::format("{:5.1f} ({:.1f} ... {:.1f})", 100.0 * count / trials, 100.0 * bounds.low,
                       100.0 * bounds.high);
}

/// The engine that is looked at, and what it is held against.
struct Pair {
    const trial::EngineKind& engine;
    const trial::EngineKind& reference;
};

std::string formatTable(const Pair& pair, const std::vector<verify::Agreement>& table, int trials) {
    constexpr const char* kRow = "{:<8} {:<8} {:<8} {:<22} {:>8} {:<22} {:>8} {:>8} {:>7} {:>8}  {:<5} {}\n";
    std::string text = fmt::format(
        "\n{} against {}: {} trials of each part on each track, the same starts in both; shares in "
        "% with 95 % Clopper-Pearson bounds\n",
        pair.engine.title, pair.reference.title, trials);
    text += fmt::format(fmt::runtime(kRow), "Part", "Track", "Engine", "finished", "p", "success", "p",
                        "median s", "KS D", "KS p", "alone", "Verdict");
    for (const verify::Agreement& row : table) {
        text += fmt::format(fmt::runtime(kRow), row.part, row.track, pair.engine.name,
                            formatShare(row.engine.finished, trials), fmt::format("{:.2g}", row.finishedP),
                            formatShare(row.engine.oriented, trials), fmt::format("{:.2g}", row.orientedP),
                            fmt::format("{:.3f}", row.engine.medianTime),
                            fmt::format("{:.3f}", row.times.statistic), fmt::format("{:.2g}", row.times.p),
                            row.alikeAlone ? "yes" : "no", row.passed() ? "pass" : "FAIL");
        text += fmt::format(fmt::runtime(kRow), "", "", pair.reference.name,
                            formatShare(row.reference.finished, trials), "",
                            formatShare(row.reference.oriented, trials), "",
                            fmt::format("{:.3f}", row.reference.medianTime), "", "", "", "");
    }
    for (const verify::Agreement& row : table) {
        if (!row.freshP) continue;
        text += fmt::format("{} on {}: significant on these starts; on {} fresh ones p = {:.2g} (Holm)\n",
                            row.part, row.track, trials, *row.freshP);
    }
    return text +
           "p: McNemar's test of the rates, Kolmogorov and Smirnov's of the transit times of those that "
           "finished.\n"
           "alone: each rate lies in the other's bounds and the times have p > 0.01, which by chance some "
           "rows "
           "of engines that are alike miss.\n"
           "Verdict: none of the row's p is significant at 5 % among all of the table (Holm), or not again "
           "on fresh "
           "starts.\n";
}

nlohmann::ordered_json toJson(const verify::EngineTally& tally, int trials) {
    return {{"finished", shareToJson(tally.finished, trials)},
            {"oriented", shareToJson(tally.oriented, trials)},
            {"median_transit_s", tally.medianTime}};
}

nlohmann::ordered_json toJson(const Pair& pair, const verify::Agreement& row) {
    const auto fresh = row.freshP ? nlohmann::ordered_json(*row.freshP) : nlohmann::ordered_json();
    return {{"part", row.part},
            {"track", row.track},
            {pair.engine.name, toJson(row.engine, row.trials)},
            {pair.reference.name, toJson(row.reference, row.trials)},
            {"finished_in_one_only", row.finishedInOne},
            {"finished_p", row.finishedP},
            {"oriented_p", row.orientedP},
            {"transit_ks", row.times.statistic},
            {"transit_p", row.times.p},
            {"family_p", row.familyP},
            {"fresh_p", fresh},
            {"alike_alone", row.alikeAlone},
            {"passed", row.passed()}};
}

}  // namespace

Attempt<nlohmann::ordered_json> runAgreement(const trial::EngineKind& kind, const AgreementOptions& options,
                                             const Console& console) {
    const auto learned = track::readTrackFile(study::findResourceTrack("cuboid_track.json"));
    if (!learned) return Failure{ExitCode::badInput, learned.error().message};
    const auto scenes =
        verify::makeAgreementScenes(std::make_shared<const track::Track>(learned->track), options.trials);
    if (!scenes) return Failure{ExitCode::fault, scenes.error().message};
    const Pair pair{kind, engines::registry().reference()};
    const auto engine = pair.engine.make({options.threads, 0.0});
    const auto reference = pair.reference.make({options.threads, 0.0});

    base::RunControl control;
    const auto table = [&] {
        const auto total = 2 * static_cast<std::int64_t>(scenes->size()) * options.trials;
        const WorkDisplay display(console, watchTrials("Agreement", total, control));
        return verify::compareEngines(*engine, *reference, *scenes, control);
    }();
    if (!table) return describeRunFailure(control, table.error());
    console.print(formatTable(pair, *table, options.trials));
    const auto passed = std::count_if(table->begin(), table->end(),
                                      [](const verify::Agreement& row) { return row.passed(); });
    console.print(fmt::format("{} of {} rows pass\n", passed, table->size()));
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const verify::Agreement& row : *table)
        rows.push_back(toJson(pair, row));
    return nlohmann::ordered_json{{"trials", options.trials},
                                  {"passed", passed == static_cast<std::ptrdiff_t>(table->size())},
                                  {"rows", rows}};
}

}  // namespace trapwright::app
