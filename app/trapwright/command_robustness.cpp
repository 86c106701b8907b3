#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/track_subject.h"
#include "app/trapwright/work_display.h"
#include "core/stats/binomial.h"
#include "core/study/robustness.h"

namespace trapwright::app {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    SubjectRequest subject;
    study::RobustnessPlan plan;
    std::vector<double> expected;  // w x y z
    // Half widths of the box instead of the study's.
    std::optional<double> friction;
    std::optional<double> restitution;
    std::optional<double> halfStroke;   // [%]
    std::optional<double> frequency;    // [%]
    std::optional<double> angle;        // [deg]
    std::optional<double> size;         // [mm]
    std::optional<double> startOffset;  // [mm]
    std::optional<double> startSpeed;   // [mm/s]
    std::optional<double> roughness;    // [deg]
    int best = 0;                       // of the last selection, one after the other; 0: one track
};

void takeBox(const Options& options, trial::OperatingBox& box) {
    constexpr double kPercent = 0.01;
    box.friction = options.friction.value_or(box.friction);
    box.restitution = options.restitution.value_or(box.restitution);
    if (options.halfStroke) box.halfStroke = *options.halfStroke * kPercent;
    if (options.frequency) box.frequency = *options.frequency * kPercent;
    if (options.angle) box.angle = *options.angle * base::kDegree;
    if (options.startOffset) box.startOffset = *options.startOffset * base::kMillimetre;
    if (options.startSpeed) box.startSpeed = *options.startSpeed * base::kMillimetre;
    if (options.roughness) box.roughness = *options.roughness * base::kDegree;
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
    return {{"trials", tally.trials()},
            {"success", shareToJson(tally.success, tally.trials())},
            {"wrong_orientation", tally.wrongOrientation},
            {"stuck", tally.stuck},
            {"fell_off", tally.fellOff},
            {"speed_mm_s", result.speed * 1e3}};
}

Json resultsToJson(const study::Settings& settings, std::span<const study::PlaceResult> results) {
    Json list = Json::array();
    for (const study::PlaceResult& result : results) {
        Json json = placeToJson(settings, *result.trials.place);
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

/// Makes the subject what is asked for, and measures it; keeps what comes of it if that is wanted.
Attempt<study::Robustness> measure(TrackSubject& subject, const Options& options, const Console& console) {
    const auto expected = readExpected(options.expected);
    if (!expected) return expected.error();
    if (*expected) subject.goal = **expected;
    study::StudyInputs& inputs = subject.inputs;
    takeBox(options, inputs.settings.box);
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{ExitCode::usage, checked.error().message};

    const base::RunControl control;
    auto robustness = [&] {
        const std::int64_t trials = study::countRobustnessTrials(inputs.settings, options.plan);
        const WorkDisplay display(console, watchTrials("Robustness", trials, control));
        return study::measureRobustness(inputs, subject.track, subject.goal, options.plan, control);
    }();
    if (!robustness) return describeRunFailure(control, robustness.error());
    if (options.subject.save) {
        const auto saved = subject.file->saveRobustness(
            {subject.individual, inputs.engine->name(), inputs.settings.box, *robustness});
        if (!saved) return Failure{ExitCode::cannotWrite, saved.error().message};
    }
    noteRemadeTrials(inputs, console);
    subject.json["engine"] = inputs.engine->name();
    subject.json["robustness"] = toJson(inputs.settings, *robustness);
    addRemadeTrials(inputs, subject.json);
    return *std::move(robustness);
}

std::string shareText(const study::PlaceResult& result) {
    const trial::Tally& tally = result.tally;
    const stats::Interval bounds = stats::calcClopperPearson(tally.success, tally.trials());
    return fmt::format("{:5.1f} ({:.1f} ... {:.1f})", 100.0 * tally.success / tally.trials(),
                       100.0 * bounds.low, 100.0 * bounds.high);
}

/// The last selection's first tracks, by their worst corner: what an average over the box does not tell.
Attempt<ExitCode> runBest(const Options& options, const Console& console) {
    if (options.subject.choice.generation || options.subject.choice.individual)
        return Failure{
            ExitCode::usage,
            "--best takes the tracks of the last selection; leave --generation and --individual out."};
    std::vector<study::SelectionEntry> entries;
    {
        auto study = openStudy(options.subject.track.file, Access::read);
        if (!study) return study.error();
        const auto selections = study->file.loadSelections();
        if (!selections) return Failure{ExitCode::badInput, selections.error().message};
        if (selections->empty())
            return Failure{ExitCode::badInput, "The winners of " + options.subject.track.file +
                                                   " were not compared yet. Run `trapwright select` first."};
        entries = selections->back().entries;
    }
    entries.resize(std::min(entries.size(), static_cast<std::size_t>(options.best)));
    struct Measured {
        study::IndividualId individual;
        study::Robustness robustness;
    };
    std::vector<Measured> measured;
    std::string engine;
    Json tracks = Json::array();
    for (const study::SelectionEntry& entry : entries) {
        SubjectRequest request = options.subject;
        request.choice = {entry.generation, entry.individual};
        auto subject = loadSubject(request, console);
        if (!subject) return subject.error();
        auto robustness = measure(*subject, options, console);
        if (!robustness) {
            Failure failure = robustness.error();
            if (options.subject.save && !measured.empty())
                failure.message += fmt::format(" Tracks measured before it are kept: {}.", measured.size());
            return failure;
        }
        engine = subject->inputs.engine->name();
        tracks.push_back(subject->json);
        measured.push_back({entry, *std::move(robustness)});
    }
    std::ranges::stable_sort(measured, std::greater(), [](const Measured& one) {
        const auto share = [](const study::PlaceResult& result) {
            return static_cast<double>(result.tally.success) / result.tally.trials();
        };
        return std::pair(share(one.robustness.corners.front()), share(one.robustness.overBox));
    });
    constexpr const char* kColumns = "{:>10} {:>10}   {:<22} {:<22} {}\n";
    std::string text = fmt::format("The {} best of the last selection, by their worst corner, engine {}\n",
                                   measured.size(), engine) +
                       fmt::format(kColumns, "Generation", "Individual", "Worst corner [%]",
                                   "Over the box [%]", "As set [%]");
    for (const Measured& one : measured)
        text += fmt::format(kColumns, one.individual.generation, one.individual.individual,
                            shareText(one.robustness.corners.front()), shareText(one.robustness.overBox),
                            shareText(one.robustness.nominal));
    console.print(
        text +
        "In brackets: 95 % Clopper-Pearson, of each by itself; the first of several owes some of its "
        "number to luck.\n");
    console.emit({{"study", options.subject.track.file}, {"tracks", tracks}});
    return ExitCode::ok;
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    if (const auto checked = options.plan.check(); !checked)
        return Failure{ExitCode::usage, checked.error().message};
    if (options.best > 0 && isTrackFile(options.subject.track.file))
        return Failure{ExitCode::usage,
                       "--best needs a study, and " + options.subject.track.file + " is a track."};
    if (options.best > 0) return runBest(options, console);
    auto subject = loadSubject(options.subject, console);
    if (!subject) return subject.error();
    const auto robustness = measure(*subject, options, console);
    if (!robustness) return robustness.error();
    console.print(
        fmt::format("{}\n{}", subject->name, study::formatRobustness(subject->inputs, *robustness)));
    console.emit(subject->json);
    return ExitCode::ok;
}

}  // namespace

void addRobustnessCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "robustness",
        "Success of one track where the physics is not quite what was set: over the operating box, over each "
        "condition, in its worst corners, and the map of the worst two conditions.",
        "trapwright robustness cuboid.trap --engine native",
        [options](const Console& console) { return run(*options, console); });
    addSubjectOptions(command, options->subject);
    command.addOption("--trials", options->plan.trials, "At each place (200)");
    command.addOption("--box-trials", options->plan.boxTrials, "All over the box (1000)");
    command.addOption("--points", options->plan.sweepPoints, "Of each condition (7)");
    command.addOption("--map", options->plan.mapPoints, "Of the worst two conditions' map, each way (5)");
    command.addOption("--friction-range", options->friction,
                      "Half of it, instead of the study's, as of the eight below");
    command.addOption("--restitution-range", options->restitution, "Half of it");
    command.addOption("--half-stroke-range", options->halfStroke, "Half of it in %");
    command.addOption("--frequency-range", options->frequency, "Half of it in %");
    command.addOption("--angle-range", options->angle, "Half of it in degrees");
    command.addOption("--size-range", options->size, "How much less or more a part's extents may be, in mm");
    command.addOption("--offset-range", options->startOffset,
                      "How far to the sides starts may be off, in mm");
    command.addOption("--speed-range", options->startSpeed, "How fast parts may start at most, in mm/s");
    command.addOption("--roughness-range", options->roughness, "How far the surface may lean, in degrees");
    command
        .addOption("--expected", options->expected,
                   "The orientation that counts as success, w x y z (default: the most frequent final one "
                   "as set)")
        .values(4);
    command
        .addOption("--best", options->best,
                   "So many tracks of the last selection, one after the other, told by their worst corner")
        .range(1, 1000);
}

}  // namespace trapwright::app
