#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/study/robustness.h"
#include "core/study/track_design.h"

namespace trapwright::app {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string study;
    IndividualChoice choice;
    study::RobustnessPlan plan;
    std::vector<double> expected;  // w x y z
    // Half widths of the box instead of the study's.
    std::optional<double> friction;
    std::optional<double> restitution;
    std::optional<double> halfStroke;  // [%]
    std::optional<double> frequency;   // [%]
    std::optional<double> angle;       // [deg]
    std::optional<double> size;        // [mm]
    std::optional<std::string> engine;
    unsigned threads = 0;
};

void takeBox(const Options& options, trial::OperatingBox& box) {
    constexpr double kPercent = 0.01;
    box.friction = options.friction.value_or(box.friction);
    box.restitution = options.restitution.value_or(box.restitution);
    if (options.halfStroke) box.halfStroke = *options.halfStroke * kPercent;
    if (options.frequency) box.frequency = *options.frequency * kPercent;
    if (options.angle) box.angle = *options.angle * base::kDegree;
    if (options.size) box.sizeBelow = box.sizeAbove = *options.size * base::kMillimetre;
}

Json placeToJson(const study::Settings& settings, const trial::BoxPlace& place) {
    Json json = Json::object();
    for (const trial::ConditionText& text : trial::conditionTexts()) {
        if (!study::varies(settings.simulation, settings.box, text.condition)) continue;
        const double share = place[static_cast<std::size_t>(text.condition)];
        json[std::string(text.key)] =
            study::conditionAt(settings.simulation, settings.box, text.condition, share) * text.shownAs;
    }
    return json;
}

Json resultToJson(const study::PlaceResult& result) {
    const trial::Tally& tally = result.tally;
    return {{"success", shareToJson(tally.success, tally.trials())},
            {"wrong_orientation", tally.wrongOrientation},
            {"stuck", tally.stuck},
            {"fell_off", tally.fellOff},
            {"speed_mm_s", result.speed * 1e3}};
}

Json resultsToJson(const study::Settings& settings, std::span<const study::PlaceResult> results) {
    Json list = Json::array();
    for (const study::PlaceResult& result : results) {
        Json json = placeToJson(settings, result.place);
        json.update(resultToJson(result));
        list.push_back(std::move(json));
    }
    return list;
}

Json toJson(const study::Settings& settings, const study::Robustness& robustness) {
    const auto keyOf = [](trial::Condition condition) {
        return trial::conditionTexts()[static_cast<std::size_t>(condition)].key;
    };
    Json sweeps = Json::array();
    for (const study::ConditionSweep& sweep : robustness.sweeps)
        sweeps.push_back(
            {{"condition", keyOf(sweep.condition)}, {"points", resultsToJson(settings, sweep.points)}});
    Json json = app::goalToJson("expected_orientation", robustness.goal);
    json.update({{"as_set", resultToJson(robustness.nominal)},
                 {"over_box", resultToJson(robustness.overBox)},
                 {"sweeps", sweeps},
                 {"worst_corners", resultsToJson(settings, robustness.corners)}});
    if (robustness.worstPair)
        json["worst_pair"] = {{"across", keyOf(robustness.worstPair->across)},
                              {"up", keyOf(robustness.worstPair->up)},
                              {"places", resultsToJson(settings, robustness.worstPair->places)}};
    return json;
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    if (const auto checked = options.plan.check(); !checked)
        return Failure{ExitCode::usage, checked.error().message};
    const auto expected = readExpected(options.expected);
    if (!expected) return expected.error();
    auto study = openStudy(options.study, Access::read);
    if (!study) return study.error();
    auto individual = findIndividual(study->file, options.choice);
    if (!individual) return individual.error();
    auto inputs = makeInputs(*study, options.engine, trial::EngineUse::judging, options.threads);
    if (!inputs) return inputs.error();
    takeBox(options, inputs->settings.box);
    if (const auto checked = study::checkInputs(*inputs); !checked)
        return Failure{ExitCode::usage, checked.error().message};
    auto built = study::decodeTrack(inputs->settings.track, individual->record.design);
    if (!built) return Failure{ExitCode::badInput, built.error().message};

    const base::RunControl control;
    const auto robustness = [&] {
        const WorkDisplay display(
            console, watchTrials("Robustness", study::countRobustnessTrials(*inputs, options.plan), control));
        return study::measureRobustness(*inputs, std::make_shared<const track::Track>(std::move(*built)),
                                        *expected, options.plan, control);
    }();
    if (!robustness) return describeRunFailure(control, robustness.error());
    console.print(fmt::format("Generation {}, individual {}, engine {}\n{}", individual->generation,
                              individual->individual, inputs->engine->name(),
                              study::formatRobustness(*inputs, *robustness)));
    console.emit({{"study", options.study},
                  {"generation", individual->generation},
                  {"individual", individual->individual},
                  {"engine", inputs->engine->name()},
                  {"robustness", toJson(inputs->settings, *robustness)}});
    return ExitCode::ok;
}

}  // namespace

void addRobustnessCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "robustness",
        "Success of one track where the physics is not quite what was set: over the operating box, over each "
        "condition, in its worst corners, and the map of the worst two conditions. Nothing is stored.",
        "trapwright robustness cuboid.trap --engine native",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->study, "The study's file").required();
    addIndividualOptions(command, options->choice);
    command.addOption("--trials", options->plan.trials, "At each place (200)");
    command.addOption("--box-trials", options->plan.boxTrials, "All over the box (1000)");
    command.addOption("--points", options->plan.sweepPoints, "Of each condition (7)");
    command.addOption("--map", options->plan.mapPoints, "Of the worst two conditions' map, each way (5)");
    command.addOption("--friction", options->friction,
                      "Half of its range, instead of the study's, as the five below");
    command.addOption("--restitution", options->restitution, "Half of its range");
    command.addOption("--half-stroke", options->halfStroke, "Half of its range in %");
    command.addOption("--frequency", options->frequency, "Half of its range in %");
    command.addOption("--angle", options->angle, "Half of its range in degrees");
    command.addOption("--size", options->size, "How much less or more a part's extents may be, in mm");
    command
        .addOption("--expected", options->expected,
                   "The orientation that counts as success, w x y z (default: the most frequent final one "
                   "as set)")
        .values(4);
    command.addOption("--engine", options->engine, "What simulates (default: as in the study)");
    command.addOption("--threads", options->threads, "Threads (default: all processors)");
}

}  // namespace trapwright::app
