#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/study_access.h"
#include "core/study/physical_table.h"
#include "core/study/pose_weights.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string study;
    std::optional<int> number;  // from 1
    bool csv = false;
    bool trials = false;
};

nlohmann::ordered_json toJson(const study::PhysicalRow& row) {
    const auto side = [](const study::SuccessCount& count) {
        return nlohmann::ordered_json{{"success", shareToJson(count.tally.success, count.tally.trials())},
                                      {"wrong_orientation", count.tally.wrongOrientation},
                                      {"stuck", count.tally.stuck},
                                      {"fell_off", count.tally.fellOff}};
    };
    nlohmann::ordered_json json{{"simulated", side(row.simulated)}, {"physical", side(row.physical)}};
    if (!row.poses.empty()) {
        json["poses"] = numbersToJson(row.poses);
        json["weight"] = row.weight;
    }
    if (row.p) json["p"] = *row.p;
    return json;
}

const char* feederText(const study::FeederCount& feeders) {
    if (feeders.mixed()) return "virtual feeder and others, mixed";
    return feeders.virtualFeeder > 0 ? "virtual feeder" : "feeder";
}

nlohmann::ordered_json weightedToJson(const study::SuccessCount& count) {
    return app::toJson(stats::WeightedRate{count.rate, count.bounds});
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto study = openStudy(options.study, Access::read);
    if (!study) return study.error();
    const auto physical = study->file.loadPhysicalValidations();
    if (!physical) return Failure{ExitCode::badInput, physical.error().message};
    const auto simulated = study->file.loadValidations();
    if (!simulated) return Failure{ExitCode::badInput, simulated.error().message};
    const int count = static_cast<int>(physical->size());
    if (count == 0) {
        return Failure{ExitCode::badInput, fmt::format("No track of the study {} was tried on a real feeder. "
                                                       "The studio's page Validate does that.",
                                                       options.study)};
    }
    const int number = options.number.value_or(count);
    if (number < 1 || number > count) {
        return Failure{ExitCode::usage, fmt::format("--number {}: the study {} has the validations 1 to {}.",
                                                    number, options.study, count)};
    }
    const study::PhysicalValidation& one = (*physical)[static_cast<std::size_t>(number - 1)];
    const study::PhysicalTable table = study::comparePhysical(
        study::findSimulated(*simulated, one), one, study::weighPoseGroups(*study->part, study->settings));
    if (options.trials) {
        console.print(study::physicalTrialsCsv(one));
    } else if (options.csv) {
        console.print(study::physicalTableCsv(table));
    } else {
        console.print(fmt::format("Validation {} of {} on the {}, begun {}; generation {}, individual {}\n{}",
                                  number, count, feederText(table.feeders), one.started, one.generation,
                                  one.individual, study::formatPhysical(table)));
    }
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const study::PhysicalRow& row : table.rows)
        rows.push_back(toJson(row));
    console.emit({{"study", options.study},
                  {"number", number},
                  {"generation", one.generation},
                  {"individual", one.individual},
                  {"feeder",
                   {{"real", table.feeders.real},
                    {"unconnected", table.feeders.unconnected},
                    {"virtual", table.feeders.virtualFeeder},
                    {"unknown", table.feeders.unknown}}},
                  {"notice", table.notice},
                  {"rows", rows},
                  {"weighted",
                   {{"simulated", weightedToJson(table.weighted.simulated)},
                    {"physical", weightedToJson(table.weighted.physical)}}},
                  {"total", toJson(table.total)},
                  {"verdict", table.verdict}});
    return ExitCode::ok;
}

}  // namespace

void addPhysicalCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "physical",
        "A printed track on the real feeder beside its simulation, pose by pose, and whether they differ. "
        "Poses that look the same are one.",
        "trapwright physical cuboid.trap",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->study, "The study's file").required();
    command.addOption("--number", options->number, "Which validation, from 1 (default: the last)");
    command.addFlag("--csv", options->csv, "The table as CSV");
    command.addFlag("--trials", options->trials, "Every trial as CSV");
}

}  // namespace trapwright::app
