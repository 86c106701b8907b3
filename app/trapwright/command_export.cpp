#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/trapwright/command.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/print_options.h"
#include "app/trapwright/study_access.h"
#include "app/trapwright/study_jobs.h"
#include "app/trapwright/track_subject.h"
#include "core/study/track_design.h"
#include "core/workflow/track_export.h"

namespace trapwright::app {

namespace {

struct Options {
    std::string source;  // a study, or a track's file
    std::vector<std::string> files;
    IndividualChoice choice;
    PrintRequest print;
};

/// Beside the study or the track, with its name.
std::vector<std::string> defaultFiles(const std::string& source) {
    return {std::filesystem::path(source).replace_extension(".stl").string(),
            std::filesystem::path(source).replace_extension(".3mf").string()};
}

/// What is exported, and which that is, for machines.
struct Source {
    track::TrackFile design;
    nlohmann::ordered_json json;
};

/// How the last selection found this individual's parts to end; none if it is not in there, or if more than
/// one orientation is right, which a track's file cannot say.
std::optional<base::Quaternion> findExpectedOrientation(const store::StudyFile& file,
                                                        const study::Individual& individual) {
    const auto selections = file.loadSelections();
    if (!selections || selections->empty()) return std::nullopt;
    for (const study::SelectionEntry& entry : selections->back().entries) {
        if (isSameIndividual(entry, individual) && entry.goal.isOneOrientation()) return entry.goal.shown();
    }
    return std::nullopt;
}

Attempt<Source> loadOfStudy(const Options& options) {
    const auto file = store::StudyFile::openReadOnly(options.source);
    if (!file) return Failure{ExitCode::badInput, file.error().message};
    const auto settings = file->loadSettings();
    if (!settings) return Failure{ExitCode::badInput, settings.error().message};
    auto individual = findIndividual(*file, options.choice);
    if (!individual) return individual.error();
    auto track = study::decodeTrack(settings->track, individual->record.design);
    if (!track) return Failure{ExitCode::badInput, track.error().message};
    const std::string name =
        fmt::format("{}, generation {}, individual {}", std::filesystem::path(options.source).stem().string(),
                    individual->generation, individual->individual);
    return Source{{name, std::move(*track), findExpectedOrientation(*file, *individual)},
                  {{"study", options.source},
                   {"generation", individual->generation},
                   {"individual", individual->individual}}};
}

Attempt<Source> loadOfFile(const Options& options) {
    if (options.choice.generation || options.choice.individual)
        return Failure{ExitCode::usage,
                       fmt::format("--generation and --individual choose from a study, and {} is a track.",
                                   options.source)};
    auto file = track::readTrackFile(options.source);
    if (!file) return Failure{ExitCode::badInput, file.error().message};
    return Source{std::move(*file), {{"track", options.source}}};
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto source = isTrackFile(options.source) ? loadOfFile(options) : loadOfStudy(options);
    if (!source) return source.error();
    const track::TrackFile& design = source->design;
    auto means = findPrintMeans(options.print);
    if (!means) return means.error();
    const auto solid = track::buildPrintSolid(design.track, toPrintOptions(options.print, means->limits));
    if (!solid) return Failure{ExitCode::usage, solid.error().message};
    auto pieces = buildPieces(design.track, options.print, *means);
    if (!pieces) return pieces.error();
    std::vector<geometry::TriangleMesh> solids;
    for (const track::PrintPiece& piece : *pieces)
        solids.push_back(piece.solid);

    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const std::string& path : options.files.empty() ? defaultFiles(options.source) : options.files) {
        const auto exported = workflow::exportTrack(design, solids, path);
        if (!exported) return toFailure(exported.error());
        for (const workflow::ExportedFile& written : *exported) {
            console.print(describeExport(written));
            files.push_back({{"file", written.path.string()},
                             {"size_mm", toJson(written.size, 1e3)},
                             {"solids", written.solids},
                             {written.isStep ? "faces" : "triangles", written.faces},
                             {"volume_mm3", written.volume * 1e9},
                             {"closed_and_manifold", true},
                             {"overlapping_triangles", written.overlappingTriangles}});
        }
    }
    const geometry::PrintReport report = geometry::checkForPrinting(*solid, means->limits);
    console.print(describeFlaws(report));
    nlohmann::ordered_json print = flawsToJson(report);
    if (means->printer) {
        console.print(describeFit(*pieces, *means->printer));
        print["pieces"] = fitToJson(*pieces, *means->printer);
    }
    nlohmann::ordered_json json = std::move(source->json);
    json["files"] = std::move(files);
    json["print"] = std::move(print);
    console.emit(json);
    return ExitCode::ok;
}

}  // namespace

void addExportCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command = addCommand(
        program, invocation, "export",
        "Writes a track for printing as binary STL or 3MF, for machining as STEP, or as JSON for `trapwright "
        "track`, in mm, and checks what was written.\nWalls and flange are printed around the surface, which "
        "stays as it was learned; what a printer may fail at is told. What is too long for a printer's bed "
        "is "
        "cut into pieces that dowels hold together.",
        "trapwright export cuboid.trap track.3mf --printer prusa-mk4 --split",
        [options](const Console& console) { return run(*options, console); });
    command.addOption("STUDY|TRACK", options->source, "A study, or a track as JSON in mm").required();
    command.addOption(
        "FILE", options->files,
        "Files to write, .stl, .3mf, .step or .json (default: STL and 3MF, beside the study or the track)");
    addIndividualOptions(command, options->choice);
    addPrintOptions(command, options->print);
}

}  // namespace trapwright::app
