#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/trapwright/command.h"
#include "app/trapwright/study_access.h"
#include "core/base/file.h"
#include "core/stats/binomial.h"
#include "core/study/comparison.h"
#include "core/workflow/compared_study.h"

namespace trapwright::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kPercent = 100.0;

struct Options {
    std::vector<std::string> studies;
    std::optional<std::string> curves;
};

Attempt<study::ComparedStudy> load(const std::string& path) {
    const auto opened = openStudy(path, Access::read);
    if (!opened) return opened.error();
    auto compared = workflow::loadCompared(opened->file, path);
    if (!compared) return Failure{ExitCode::badInput, compared.error().message};
    return std::move(*compared);
}

/// "98.4  97.4 ... 99.1"; a dash where nothing was counted.
std::string describeRate(const std::optional<stats::Count>& rate) {
    if (!rate) return fmt::format("{:>5} {:>16}", "-", "");
    const stats::Interval bounds = stats::calcClopperPearson(rate->successes, rate->trials);
    return fmt::format("{:5.1f} {:>5.1f} ... {:5.1f}", kPercent * rate->share(), kPercent * bounds.low,
                       kPercent * bounds.high);
}

Json toJson(const std::optional<stats::Count>& rate) {
    if (!rate) return {};
    const stats::Interval bounds = stats::calcClopperPearson(rate->successes, rate->trials);
    return {{"count", rate->successes}, {"of", rate->trials}, {"low", bounds.low}, {"high", bounds.high}};
}

Json toJson(const stats::Quartiles& quartiles) {
    return {{"lower", quartiles.lower}, {"median", quartiles.median}, {"upper", quartiles.upper}};
}

Json toJson(const std::optional<stats::Quartiles>& quartiles) {
    return quartiles ? toJson(*quartiles) : Json();
}

double secondsOf(const study::ComparedStudy& study) {
    double seconds = 0.0;
    for (const study::GenerationSummary& generation : study.generations)
        seconds += generation.seconds;
    return seconds;
}

std::string describeTable(const std::vector<study::ComparedStudy>& studies) {
    std::size_t width = 5;
    for (const study::ComparedStudy& study : studies)
        width = std::max(width, study.name.size());
    std::string text = fmt::format(
        "{:{}} {:>10} {:>11} {:>8}   {:^22}   {:^22}\n{:{}} {:>10} {:>11} {:>8}   {:^22}   {:^22}\n", "",
        width, "", "", "", "learning counted", "fresh trials", "Study", width, "seed", "generations",
        "time [s]", "[%], 95 % bounds", "[%], 95 % bounds");
    for (const study::ComparedStudy& study : studies)
        text += fmt::format("{:{}} {:>10} {:>11} {:>8.0f}   {:22}   {}\n", study.name, width, study.seed,
                            study.generations.size(), secondsOf(study), describeRate(study::bestRate(study)),
                            describeRate(study::selectedRate(study)));
    return text;
}

std::string describeQuartiles(const std::vector<study::ComparedStudy>& studies) {
    std::string text;
    const auto add = [&](const char* what, const std::optional<stats::Quartiles>& quartiles) {
        if (quartiles)
            text += fmt::format("{}: median {:.1f} %, quartiles {:.1f} and {:.1f} %\n", what,
                                kPercent * quartiles->median, kPercent * quartiles->lower,
                                kPercent * quartiles->upper);
    };
    add("Learning counted", study::spreadOf(studies, study::bestRate));
    add("Fresh trials", study::spreadOf(studies, study::selectedRate));
    return text;
}

std::string writeCurves(const std::vector<study::GenerationSpread>& spreads) {
    std::string text =
        "generation,studies,fitness_lower,fitness_median,fitness_upper,success_lower,success_median,"
        "success_upper,top_success_lower,top_success_median,top_success_upper\n";
    const auto fields = [](const std::optional<stats::Quartiles>& quartiles) {
        if (!quartiles) return std::string(",,,");
        return fmt::format(",{},{},{}", quartiles->lower, quartiles->median, quartiles->upper);
    };
    for (const study::GenerationSpread& spread : spreads)
        text += fmt::format("{},{}{}{}{}\n", spread.generation, spread.studies, fields(spread.fitness),
                            fields(spread.success), fields(spread.topSuccess));
    return text;
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    std::vector<study::ComparedStudy> studies;
    for (const std::string& path : options.studies) {
        auto loaded = load(path);
        if (!loaded) return loaded.error();
        studies.push_back(std::move(*loaded));
    }
    const std::vector<study::GenerationSpread> spreads = study::spreadByGeneration(studies);
    if (options.curves) {
        if (const auto written = base::writeFile(*options.curves, writeCurves(spreads)); !written)
            return Failure{ExitCode::cannotWrite, written.error().message};
    }
    console.print(describeTable(studies));
    if (studies.size() > 1) console.print(describeQuartiles(studies));

    Json rows = Json::array();
    for (const study::ComparedStudy& study : studies)
        rows.push_back({{"study", study.name},
                        {"part", study.part},
                        {"seed", study.seed},
                        {"generations", study.generations.size()},
                        {"seconds", secondsOf(study)},
                        {"counts", study.fallsAreForgiven ? "correct" : "success"},
                        {"learning", toJson(study::bestRate(study))},
                        {"fresh_trials", toJson(study::selectedRate(study))}});
    Json curves = Json::array();
    for (const study::GenerationSpread& spread : spreads)
        curves.push_back({{"generation", spread.generation},
                          {"studies", spread.studies},
                          {"fitness", toJson(spread.fitness)},
                          {"success", toJson(spread.success)},
                          {"top_success", toJson(spread.topSuccess)}});
    console.emit({{"studies", rows},
                  {"learning", toJson(study::spreadOf(studies, study::bestRate))},
                  {"fresh_trials", toJson(study::spreadOf(studies, study::selectedRate))},
                  {"curves", curves}});
    return ExitCode::ok;
}

}  // namespace

void addCompareCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "compare",
        "Studies side by side, as of one task with several seeds: how far each is, what its best track\n"
        "scored, and median and quartiles of all.",
        "trapwright compare pin-1.trap pin-2.trap pin-3.trap --curves pin.csv",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY", options->studies, "The studies' files").type("FILE").required();
    command
        .addOption("--curves", options->curves,
                   "Also write median and quartiles of each generation's winners to this file, as CSV")
        .type("FILE");
}

}  // namespace trapwright::app
