#include "app/trapwright/study_access.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/trapwright/engines.h"
#include "app/trapwright/program.h"
#include "core/base/parallel.h"
#include "core/study/selection.h"
#include "core/workflow/study_design.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

Failure describeStudyFailure(const base::Error& error, ExitCode otherwise) {
    switch (error.kind) {
        case base::ErrorKind::damaged:
            return {ExitCode::badInput, error.message};
        case base::ErrorKind::cannotWrite:
            return {ExitCode::cannotWrite, error.message};
        case base::ErrorKind::busy:
            return {ExitCode::locked, error.message};
        case base::ErrorKind::unattainable:
            return {ExitCode::usage, error.message};
        case base::ErrorKind::other:
            break;
    }
    return {otherwise, error.message};
}

Failure describeCreateFailure(const std::string& path, const base::Error& error) {
    std::error_code failure;
    return describeStudyFailure(
        error, std::filesystem::exists(path, failure) ? ExitCode::usage : ExitCode::cannotWrite);
}

Attempt<OpenStudy> openStudy(const std::string& path, Access access) {
    auto file = access == Access::write ? store::StudyFile::open(path, kProgram)
                                        : store::StudyFile::openReadOnly(path);
    if (!file) {
        if (access == Access::write) return describeStudyFailure(file.error(), ExitCode::badInput);
        return Failure{ExitCode::badInput, file.error().message};
    }
    return loadStudy(std::move(*file));
}

Attempt<OpenStudy> loadStudy(store::StudyFile file) {
    auto design = workflow::loadDesign(file);
    if (!design) return Failure{ExitCode::badInput, design.error().message};
    return OpenStudy{std::move(file), std::move(design->settings), std::move(design->part)};
}

void addIndividualOptions(Command command, IndividualChoice& choice) {
    const Option generation =
        command.addOption("--generation", choice.generation, "Of the individual, from 0");
    command
        .addOption(
            "--individual", choice.individual,
            "Its number in the generation, from 0 (default: the winner). Without both: the final track that "
            "was chosen in the studio, or else the first of the last selection, or the winner with the "
            "greatest success")
        .needs(generation);
}

Attempt<study::Individual> findIndividual(const store::StudyFile& file, const IndividualChoice& choice) {
    const auto count = file.generationCount();
    if (!count) return Failure{ExitCode::badInput, count.error().message};
    if (*count == 0) {
        return Failure{ExitCode::badInput,
                       fmt::format("The study {} has no generations yet. Learn some first: "
                                   "trapwright evolve {}",
                                   file.path().string(), file.path().string())};
    }
    int generation = 0;
    int individual = 0;
    if (choice.generation) {
        generation = *choice.generation;
        if (generation < 0 || generation >= *count) {
            return Failure{ExitCode::usage,
                           fmt::format("--generation {}: the study {} has the generations 0 to {}.",
                                       generation, file.path().string(), *count - 1)};
        }
        const auto record = file.loadGeneration(generation);
        if (!record) return Failure{ExitCode::badInput, record.error().message};
        individual = choice.individual.value_or(record->winner);
        const int size = static_cast<int>(record->individuals.size());
        if (individual < 0 || individual >= size) {
            return Failure{ExitCode::usage,
                           fmt::format("--individual {}: generation {} has the individuals 0 to {}.",
                                       individual, generation, size - 1)};
        }
        return study::Individual{{generation, individual},
                                 record->individuals[static_cast<std::size_t>(individual)]};
    }
    const auto chosen = file.loadChosenWinner();
    if (!chosen) return Failure{ExitCode::badInput, chosen.error().message};
    if (const auto& place = *chosen) {
        auto record = file.loadIndividual(*place);
        if (!record) return Failure{ExitCode::badInput, record.error().message};
        return study::Individual{*place, std::move(*record)};
    }
    const auto selections = file.loadSelections();
    if (!selections) return Failure{ExitCode::badInput, selections.error().message};
    if (!selections->empty() && !selections->back().entries.empty()) {
        const study::SelectionEntry& first = selections->back().entries.front();
        auto record = file.loadIndividual(first);
        if (!record) return Failure{ExitCode::badInput, record.error().message};
        return study::Individual{first, std::move(*record)};
    }
    auto winners = file.loadWinners();
    if (!winners) return Failure{ExitCode::badInput, winners.error().message};
    const auto settings = file.loadSettings();
    if (!settings) return Failure{ExitCode::badInput, settings.error().message};
    return *study::findBestWinner(*winners, study::forgivesFalls(settings->evolution));
}

Attempt<study::StudyInputs> makeInputs(const OpenStudy& study, const std::optional<std::string>& engine,
                                       trial::EngineUse use, unsigned threads) {
    const auto remade = std::make_shared<trial::RemadeTrials>();
    auto made =
        makeEngine(engines::registry().nameFor(engine.value_or(study.settings.simulation.engine), use),
                   {threads, 0.0, nullptr, remade});
    if (!made) return made.error();
    return study::StudyInputs{study.settings, study.part, *made,
                              threads == 0 ? base::availableThreads() : threads, remade};
}

Attempt<std::optional<trial::Goal>> readExpected(const std::vector<double>& values) {
    if (values.empty()) return std::optional<trial::Goal>();
    const base::Quaternion expected(values[0], values[1], values[2], values[3]);
    if (!(expected.norm() > 0.0)) return Failure{ExitCode::usage, "--expected must not be all zero."};
    return std::optional(trial::makeGoal(expected.normalized()));
}

void addConditionsOption(Command command, std::optional<std::string>& conditions) {
    command
        .addOption("--conditions", conditions,
                   "nominal: all trials as set; varied: over the operating box (default: as in the study)")
        .type("CONDITIONS");
}

Attempt<ExitCode> takeConditions(const std::optional<std::string>& conditions, study::Settings& settings) {
    if (!conditions) return ExitCode::ok;
    auto taken = study::settingsFromJson(nlohmann::json{{"validation", {{"conditions", *conditions}}}}.dump(),
                                         settings);
    if (!taken)
        return Failure{ExitCode::usage,
                       fmt::format("--conditions is \"{}\"; it must be nominal or varied.", *conditions)};
    settings = std::move(*taken);
    return ExitCode::ok;
}

}  // namespace trapwright::app
