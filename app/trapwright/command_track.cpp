#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/track_source.h"
#include "app/trapwright/work_display.h"
#include "core/stats/binomial.h"
#include "core/study/evaluator.h"
#include "core/study/orientation_shares.h"
#include "core/study/trial_batches.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

struct Options {
    TrackRequest track;
    int trials = 1000;
    double step = 0.0;  // [ms]; 0: the engine's own
    std::string engine = engines::registry().reference().name;
    unsigned threads = 0;
};

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
    auto loaded = loadTrack(options.track, console);
    if (!loaded) return loaded.error();
    auto engine = makeJudge(options.engine, {options.threads, options.step * 1e-3});
    if (!engine) return engine.error();
    const std::shared_ptr<const part::Part> part = loaded->part;
    study::Settings& settings = loaded->settings;
    settings.evolution.trialsPerEvaluation = options.trials;
    if (const auto checked = study::checkInputs({settings, part, *engine}); !checked)
        return Failure{ExitCode::usage, checked.error().message};

    const trial::TrialBatch batch = study::makeTrackBatch(loaded->track, part, settings.simulation,
                                                          settings.evolution.seed, options.trials);
    base::RunControl control;
    const auto outcomes = [&] {
        const WorkDisplay display(console, watchTrials("Simulating", options.trials, control));
        return study::runTrials(**engine, {&batch, 1}, control);
    }();
    if (!outcomes) return describeRunFailure(control, outcomes.error());
    const study::TrialCounts counts = study::countTrials(outcomes->front(), part->symmetry, loaded->expected,
                                                         settings.validation.tolerance);

    const std::vector<study::EndMode> modes =
        study::findEndModes(*part, outcomes->front(), settings.validation.tolerance, kMostModes);

    const track::FeederShape& shape = batch.track->shape;
    const double throwNumber = trial::calcThrowNumber(trial::seenFromTrack(batch.drive, shape),
                                                      batch.gravity * std::cos(shape.slope));
    console.print(fmt::format("{}: part {}, half-stroke {:g} mm, throw number {:.3f}, engine {}\n",
                              options.track.file, part->name, options.track.halfStroke, throwNumber,
                              (*engine)->name()) +
                  describeShare("Finished", counts.tally.finished(), counts.tally.trials()) +
                  describeShare("Fell off", counts.tally.fellOff, counts.tally.trials()) +
                  describeShare("Stuck", counts.tally.stuck, counts.tally.trials()) +
                  describeShare("Success", counts.tally.success, counts.tally.trials()) +
                  fmt::format("Success: finished within {:g} deg of {}.\n", options.track.tolerance,
                              loaded->expected ? "the orientation that the file expects"
                                               : "the most frequent final orientation") +
                  describeModes(modes, counts.tally.trials()));
    console.emit({{"track", options.track.file},
                  {"part", part->name},
                  {"engine", (*engine)->name()},
                  {"half_stroke_mm", options.track.halfStroke},
                  {"throw_number", throwNumber},
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
    Command command =
        addCommand(program, invocation, "track",
                   "Simulates parts on a track file: how many finish, fall off, get stuck, are oriented.",
                   "trapwright track resources/tracks/cuboid_track.json --part cuboid --trials 1000",
                   [options](const Console& console) { return run(*options, console); });
    command.addOption("FILE", options->track.file, "The track, JSON in mm").required();
    addTrackOptions(command, options->track);
    command.addOption("--trials", options->trials, "How many (1000)");
    command.addOption("--step", options->step, "Of simulated time in ms (the engine's own)").range(1e-4, 2.0);
    command.addOption("--engine", options->engine, fmt::format("What simulates ({})", options->engine));
    command.addOption("--threads", options->threads, "Threads (default: all processors)");
}

}  // namespace trapwright::app
