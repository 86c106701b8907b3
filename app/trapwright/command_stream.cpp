#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/option_values.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/track_subject.h"
#include "app/trapwright/work_display.h"
#include "core/study/stream.h"

namespace trapwright::app {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    SubjectRequest subject;
    std::vector<double> inflows;  // [1/min]
    // Instead of the study's.
    std::optional<int> streams;
    std::optional<double> duration;  // [s]
    std::optional<double> warmUp;    // [s]
    std::vector<double> expected;    // w x y z
    bool regular = false;
    bool anyhow = false;
    bool nominal = false;
    std::optional<std::string> returns;
};

Json toJson(const stats::MeanEstimate& estimate, double scale = 1.0) {
    return {{"mean", scale * estimate.mean},
            {"low", scale * estimate.interval.low},
            {"high", scale * estimate.interval.high}};
}

Json toJson(const study::StreamResult& result) {
    const study::StreamCounts sum = result.sum();
    Json json = {{"inflow_per_min", result.partsPerMinute},
                 {"offered_per_min", toJson(result.rate(&study::StreamCounts::offered))},
                 {"entered_per_min", toJson(result.rate(&study::StreamCounts::entered))},
                 {"arrived_per_min", toJson(result.arrivals())},
                 {"oriented_per_min", toJson(result.rate(&study::StreamCounts::success))}};
    const auto share = result.successShare();
    json["success"] = share ? toJson(*share) : Json();
    const auto efficiency = result.efficiency();
    json["efficiency"] = efficiency ? toJson(*efficiency) : Json();
    json.update({{"returned_per_min", toJson(result.rate(&study::StreamCounts::returned))},
                 {"fell_off_per_min", toJson(result.rate(&study::StreamCounts::fellOff))},
                 {"counts",
                  {{"offered", sum.offered},
                   {"entered", sum.entered},
                   {"success", sum.success},
                   {"wrong_orientation", sum.wrong},
                   {"returned", sum.returned},
                   {"fell_off", sum.fellOff}}},
                 {"transit_s", result.transit},
                 {"spacing_s", result.spacing},
                 {"spacing_tenth_s", result.closest},
                 {"jammed_share", result.jammedShare()},
                 {"jams", sum.jams},
                 {"streams_that_end_jammed", sum.uncleared},
                 {"streams_that_are_full", result.countFull()}});
    return json;
}

Json toJson(const study::Streams& streams) {
    Json results = Json::array();
    for (const study::StreamResult& result : streams.results)
        results.push_back(toJson(result));
    Json json = goalToJson("expected_orientation", streams.goal);
    json.update({{"streams", streams.settings.streams},
                 {"duration_s", streams.settings.duration},
                 {"warm_up_s", streams.settings.warmUp},
                 {"results", results},
                 {"bounds", "95 % Student over streams; of shares at least Clopper-Pearson"}});
    return json;
}

void takeOptions(const Options& options, study::Settings& settings) {
    study::StreamSettings& stream = settings.stream;
    stream.streams = options.streams.value_or(stream.streams);
    stream.duration = options.duration.value_or(stream.duration);
    stream.warmUp = options.warmUp.value_or(stream.warmUp);
    if (options.regular) stream.arrivals = study::Arrivals::regular;
    if (options.anyhow) stream.delivery = study::Delivery::anyhow;
    if (options.nominal) settings.validation.conditions = study::TrialConditions::nominal;
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto subject = loadSubject(options.subject, console);
    if (!subject) return subject.error();
    const auto expected = readExpected(options.expected);
    if (!expected) return expected.error();
    if (*expected) subject->goal = **expected;
    study::StudyInputs& inputs = subject->inputs;
    takeOptions(options, inputs.settings);
    if (options.returns) {
        const auto changed =
            study::settingsFromJson(Json{{"track", {{"returns", *options.returns}}}}.dump(), inputs.settings);
        if (!changed) return Failure{ExitCode::usage, "--returns: " + changed.error().message};
        inputs.settings = *changed;
    }
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{ExitCode::usage, checked.error().message};
    std::vector<double> inflows = options.inflows;
    if (inflows.empty()) {
        const auto usual = study::defaultInflows();
        inflows.assign(usual.begin(), usual.end());
    }
    for (const double inflow : inflows)
        if (const auto problems = study::findStreamProblems(inputs.settings, inflow); !problems.empty())
            return Failure{ExitCode::usage, problems.front()};

    const base::RunControl control;
    auto streams = [&] {
        const auto count = static_cast<std::int64_t>(inflows.size()) * inputs.settings.stream.streams;
        const WorkDisplay display(console, watchTrials("Streams", count, control));
        return study::measureStreams(inputs, subject->track, subject->individual, subject->goal, inflows,
                                     control);
    }();
    if (!streams) return describeRunFailure(control, streams.error());
    if (options.subject.save) {
        study::StreamsRecord record{subject->individual, inputs.engine->name(),
                                    study::boxOfJudging(inputs.settings), *streams};
        const auto saved = subject->file->saveStreams(record);
        if (!saved) return Failure{ExitCode::cannotWrite, saved.error().message};
    }
    noteRemadeTrials(inputs, console);
    console.print(fmt::format("{}\n{}", subject->name, study::formatStreams(*streams)));
    Json json = subject->json;
    json["engine"] = inputs.engine->name();
    json.update(toJson(*streams));
    addRemadeTrials(inputs, json);
    console.emit(json);
    return ExitCode::ok;
}

}  // namespace

void addStreamCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(program, invocation, "stream",
                                 "Parts that follow each other on one track, touch, push and jam: how many "
                                 "leave it as wanted a minute, "
                                 "over how many come.",
                                 "trapwright stream cuboid.trap --inflow 30 60 120",
                                 [options](const Console& console) { return run(*options, console); });
    addSubjectOptions(command, options->subject);
    command.addOption("--inflow", options->inflows, "Parts a minute, one or several (10 30 60 100 180 300)");
    command.addOption("--streams", options->streams, "Of each inflow (default: the study's)").range(2, 10000);
    command.addOption("--duration", options->duration, "Of each that counts, in s (default: the study's)");
    command.addOption("--warm-up", options->warmUp, "Before that, in s (default: the study's)");
    command.addFlag("--regular", options->regular, "Parts come after equal gaps, not at random");
    command.addFlag("--anyhow", options->anyhow,
                    "Parts come in any orientation, as while learning, not in their stable poses");
    command
        .addOption("--returns", options->returns,
                   "Where parts that fall off come again: nowhere, inner, outer or anywhere (default: as in "
                   "the study; nowhere)")
        .type("PLACE");
    command.addFlag("--nominal", options->nominal,
                    "All as set, not each stream somewhere else in the operating box");
    command
        .addOption("--expected", options->expected,
                   "The orientation that counts as success, w x y z (default: what the study wants, or the "
                   "most frequent final one of the least inflow)")
        .values(4);
}

}  // namespace trapwright::app
