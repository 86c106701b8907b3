#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/part_source.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/stats/binomial.h"
#include "core/study/evaluator.h"
#include "core/study/orientation_shares.h"
#include "core/study/trial_batches.h"
#include "core/track/track_file.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string file;
    PartRequest part;
    int trials = 1000;
    std::uint64_t seed = 1;
    double halfStroke = 0.8;  // [mm]
    std::optional<double> friction;
    std::optional<double> restitution;
    double step = 0.0;        // [ms]; 0: the engine's own
    double tolerance = 25.0;  // [deg]
    std::string engine = engines::registry().reference().name;
    unsigned threads = 0;
};

study::Settings settingsFor(const Options& options, const track::Track& track) {
    study::Settings settings;
    settings.simulation.drive.halfStroke = options.halfStroke * base::kMillimetre;
    trial::ContactParameters& contact = settings.simulation.contact;
    contact.staticFriction = options.friction.value_or(contact.staticFriction);
    contact.kineticFriction = options.friction.value_or(contact.kineticFriction);
    contact.restitution = options.restitution.value_or(contact.restitution);
    settings.evolution.trialsPerEvaluation = options.trials;
    settings.validation.tolerance = options.tolerance * base::kDegree;
    // So that a part that is too large for this track is refused.
    const double leadInEnd = track.sections[static_cast<std::size_t>(track.firstTrapSection)].x;
    settings.track.shape = track.shape;
    settings.track.segmentWidth = track.width;
    settings.track.leadInLength = leadInEnd - track.begin();
    settings.track.startFromLeadInEnd = leadInEnd - track.start;
    return settings;
}

std::string describeShare(const char* what, int count, int trials) {
    const stats::Interval bounds = stats::calcClopperPearson(count, trials);
    return fmt::format("{:<10} {:>6} of {}   {:5.1f} %   95 % Clopper-Pearson {:5.1f} ... {:5.1f} %\n", what,
                       count, trials, 100.0 * count / trials, 100.0 * bounds.low, 100.0 * bounds.high);
}

constexpr std::size_t kMostModes = 12;
constexpr double kLeans = 10.0 * base::kDegree;  // more than a part rocks by

std::string describeModes(std::span<const study::EndMode> modes, int trials) {
    if (modes.empty()) return {};
    std::string text = "Ends, of all trials: stable pose, heading\n";
    for (const study::EndMode& mode : modes) {
        text += fmt::format("  {:5.1f} %   pose {:>2}, {:+6.0f} deg", 100.0 * mode.count / trials,
                            mode.pose + 1, mode.heading / base::kDegree);
        text +=
            mode.tilt > kLeans ? fmt::format(", leaning by {:.0f} deg\n", mode.tilt / base::kDegree) : "\n";
    }
    return text;
}

nlohmann::ordered_json listModes(std::span<const study::EndMode> modes) {
    auto list = nlohmann::ordered_json::array();
    for (const study::EndMode& mode : modes) {
        list.push_back({{"pose", mode.pose + 1},
                        {"heading_deg", mode.heading / base::kDegree},
                        {"tilt_deg", mode.tilt / base::kDegree},
                        {"count", mode.count},
                        {"orientation", toJson(mode.orientation)}});
    }
    return list;
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    const auto file = track::readTrackFile(options.file);
    if (!file) return Failure{ExitCode::badInput, file.error().message};
    auto loaded = loadPart(options.part, console);
    if (!loaded) return loaded.error();
    auto engine = makeJudge(options.engine, {options.threads, options.step * 1e-3});
    if (!engine) return engine.error();
    const std::shared_ptr<const part::Part> part = loaded->part;
    const study::Settings settings = settingsFor(options, file->track);
    if (const auto checked = study::checkInputs({settings, part, *engine}); !checked)
        return Failure{ExitCode::usage, checked.error().message};

    const trial::TrialBatch batch =
        study::makeTrackBatch(std::make_shared<const track::Track>(file->track), part, settings.simulation,
                              options.seed, options.trials);
    base::RunControl control;
    const auto outcomes = [&] {
        const WorkDisplay display(console, watchTrials("Simulating", options.trials, control));
        return study::runTrials(**engine, {&batch, 1}, control);
    }();
    if (!outcomes) return describeRunFailure(control, outcomes.error());
    const study::TrialCounts counts = study::countTrials(
        outcomes->front(), part->symmetry, file->expectedOrientation, settings.validation.tolerance);

    const std::vector<study::EndMode> modes =
        study::findEndModes(*part, outcomes->front(), settings.validation.tolerance, kMostModes);

    console.print(fmt::format("{}: part {}, half-stroke {:g} mm, throw number {:.3f}, engine {}\n",
                              options.file, part->name, options.halfStroke,
                              trial::calcThrowNumber(batch.drive), (*engine)->name()) +
                  describeShare("Finished", counts.tally.finished(), counts.tally.trials()) +
                  describeShare("Fell off", counts.tally.fellOff, counts.tally.trials()) +
                  describeShare("Stuck", counts.tally.stuck, counts.tally.trials()) +
                  describeShare("Success", counts.tally.success, counts.tally.trials()) +
                  fmt::format("Success: finished within {:g} deg of {}.\n", options.tolerance,
                              file->expectedOrientation ? "the orientation that the file expects"
                                                        : "the most frequent final orientation") +
                  describeModes(modes, counts.tally.trials()));
    console.emit({{"track", options.file},
                  {"part", part->name},
                  {"engine", (*engine)->name()},
                  {"half_stroke_mm", options.halfStroke},
                  {"throw_number", trial::calcThrowNumber(batch.drive)},
                  {"trials", counts.tally.trials()},
                  {"finished", shareToJson(counts.tally.finished(), counts.tally.trials())},
                  {"fell_off", shareToJson(counts.tally.fellOff, counts.tally.trials())},
                  {"stuck", shareToJson(counts.tally.stuck, counts.tally.trials())},
                  {"oriented", shareToJson(counts.tally.success, counts.tally.trials())},
                  {"expected_orientation", toJson(counts.expected)},
                  {"ends", listModes(modes)},
                  {"mean_simulated_s", counts.simulatedTime / counts.tally.trials()}});
    return ExitCode::ok;
}

}  // namespace

void addTrackCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    options->part.part = "cuboid";
    Command command =
        addCommand(program, invocation, "track",
                   "Simulates parts on a track file: how many finish, fall off, get stuck, are oriented.",
                   "trapwright track resources/tracks/cuboid_track.json --part cuboid --trials 1000",
                   [options](const Console& console) { return run(*options, console); });
    command.addOption("FILE", options->file, "The track, JSON in mm").required();
    command.addOption("--part", options->part.part,
                      "The part: a file, or the name of a bundled one (cuboid)");
    addPartOptions(command, options->part);
    command.addOption("--trials", options->trials, "How many (1000)");
    command.addOption("--seed", options->seed, "Of the random starts (1)");
    command.addOption("--half-stroke", options->halfStroke, "Amplitude along the vibration line in mm (0.8)");
    command.addOption("--friction", options->friction, "Static and kinetic (0.5)");
    command.addOption("--restitution", options->restitution, "From 0 to 1 (0.3)");
    command.addOption("--step", options->step, "Of simulated time in ms (the engine's own)").range(1e-4, 2.0);
    command.addOption("--tolerance", options->tolerance, "Of the orientation in degrees (25)");
    command.addOption("--engine", options->engine, fmt::format("What simulates ({})", options->engine));
    command.addOption("--threads", options->threads, "Threads (default: all processors)");
}

}  // namespace trapwright::app
