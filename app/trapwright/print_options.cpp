#include "app/trapwright/print_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/trapwright/json_records.h"
#include "core/base/resources.h"
#include "core/geometry/mesh_check.h"

namespace trapwright::app {

namespace {

constexpr const char* kGroup = "What is printed";

void set(double& target, const std::optional<double>& given, double unit) {
    if (given) target = *given * unit;
}

/// Of "250x210x220"; none if it is not so.
std::optional<geometry::BuildSpace> parseBed(const std::string& text) {
    geometry::BuildSpace space;
    const char* at = text.data();
    const char* end = at + text.size();
    for (double* side : {&space.x, &space.y, &space.height}) {
        const auto [stop, error] = std::from_chars(at, end, *side);
        if (error != std::errc() || !(*side > 0.0) || !std::isfinite(*side)) return std::nullopt;
        *side *= base::kMillimetre;
        const bool isLast = side == &space.height;
        if (isLast ? stop != end : stop == end || *stop != 'x') return std::nullopt;
        at = stop + (isLast ? 0 : 1);
    }
    return space;
}

std::string describeExcess(const geometry::BedFit& fit) {
    std::string text;
    constexpr const char* kAxes[] = {"in x", "in y", "in height"};
    for (int axis = 0; axis < 3; ++axis) {
        if (fit.excess[axis] > 0.0)
            text += fmt::format("{}{:.1f} mm too large {}", text.empty() ? "" : ", ", fit.excess[axis] * 1e3,
                                kAxes[axis]);
    }
    return text;
}

}  // namespace

void addPrinterOptions(Command command, PrintRequest& request) {
    command
        .addOption(
            "--printer", request.printer,
            "For its bed, thinnest wall and steepest overhang: a name of resources/printers or of your "
            "own, as in prusa-mk4; a wrong name tells which there are")
        .type("NAME")
        .group(kGroup);
    command
        .addOption("--thinnest", request.thinnestWall,
                   "Walls thinner than this cannot be printed (the printer's, or 1.2)")
        .type("MM")
        .group(kGroup);
    command
        .addOption("--steepest", request.steepestOverhang,
                   "Overhangs that lean further from upright cannot be printed (the printer's, or 45)")
        .type("DEG")
        .range(0.0, 90.0)
        .group(kGroup);
}

void addPrintOptions(Command command, PrintRequest& request) {
    const auto add = [&](const char* name, std::optional<double>& value, const char* help) {
        command.addOption(name, value, help).type("MM").group(kGroup);
    };
    add("--base-thickness", request.baseThickness, "Below the lowest valley (default: the study's)");
    add("--wall-height", request.wallHeight,
        "Of both side walls, above what is highest beside them (0: those that the track has)");
    add("--wall-thickness", request.wallThickness, "Of the side walls, at least (2)");
    add("--rim", request.rim,
        "Beyond a border to which the surface rises so steeply that its edge would be too sharp to print, "
        "where no wall is (the printer's thinnest wall; 0: none)");
    command
        .addFlag(
            "--flange", request.flange,
            "A plate at the foot with bolt holes: at both sides of a linear feeder; in a bowl at the outer "
            "side, cut round so that it fits into the bowl")
        .group(kGroup);
    add("--flange-thickness", request.flangeThickness, "At most the base thickness (3)");
    add("--bolt-diameter", request.boltDiameter, "Of the holes (4.5, for M4; 0: no holes)");
    add("--bolt-spacing", request.boltSpacing, "Between the holes' centres (50)");
    add("--bolt-edge-distance", request.boltEdgeDistance,
        "From the holes' centres to the flange's edge; the flange is twice as wide (8)");
    add("--insert-radius", request.insertRadius,
        "Of the bowl, where the flange is cut (0, the default: the least that leaves room)");
    addPrinterOptions(command, request);
    command
        .addOption("--bed", request.bed,
                   "Bed and height of the printer, as in 250x210x220: whether the track fits is told")
        .type("MMxMMxMM")
        .group(kGroup);
    Option split =
        command.addFlag("--split", request.split,
                        "Cuts the track into as few pieces as fit on the bed, with holes for dowels");
    split.group(kGroup);
    command
        .addOption("--cut", request.cuts,
                   "Cuts at these sections instead, counted from 1 at the lead-in's end, as in 4,9")
        .separatedBy(',')
        .type("SECTION")
        .excludes(split)
        .group(kGroup);
    add("--dowel-diameter", request.dowelDiameter,
        "Of the pins that hold the pieces together (3; 0: no holes)");
    add("--dowel-depth", request.dowelDepth, "Of a pin in each of the two faces (8)");
    add("--dowel-clearance", request.dowelClearance,
        "Holes are wider and deeper than their pins by this (0.2)");
}

track::PrintOptions toPrintOptions(const PrintRequest& request, const geometry::PrintLimits& limits) {
    track::PrintOptions options;
    if (request.baseThickness) options.baseThickness = *request.baseThickness * base::kMillimetre;
    options.flange = request.flange;
    set(options.wallHeight, request.wallHeight, base::kMillimetre);
    set(options.wallThickness, request.wallThickness, base::kMillimetre);
    options.rim = limits.thinnestWall;
    set(options.rim, request.rim, base::kMillimetre);
    set(options.flangeThickness, request.flangeThickness, base::kMillimetre);
    set(options.boltDiameter, request.boltDiameter, base::kMillimetre);
    set(options.boltSpacing, request.boltSpacing, base::kMillimetre);
    set(options.boltEdgeDistance, request.boltEdgeDistance, base::kMillimetre);
    set(options.insertRadius, request.insertRadius, base::kMillimetre);
    return options;
}

Attempt<PrintMeans> findPrintMeans(const PrintRequest& request) {
    PrintMeans means;
    if (!request.printer.empty()) {
        const auto printer =
            track::findPrinter(track::readPrinters(base::findOwnFolder("printers")), request.printer);
        if (!printer) return Failure{ExitCode::usage, printer.error().message};
        means.printer = *printer;
        means.limits.thinnestWall = printer->thinnestWall;
        means.limits.steepestOverhang = printer->steepestOverhang;
    }
    if (!request.bed.empty()) {
        const auto space = parseBed(request.bed);
        if (!space) {
            return Failure{ExitCode::usage,
                           fmt::format("--bed {}: write the bed's two sides and the height in mm, as in "
                                       "250x210x220.",
                                       request.bed)};
        }
        if (!means.printer) means.printer.emplace();
        means.printer->space = *space;
    }
    set(means.limits.thinnestWall, request.thinnestWall, base::kMillimetre);
    set(means.limits.steepestOverhang, request.steepestOverhang, base::kDegree);
    return means;
}

Attempt<std::vector<track::PrintPiece>> buildPieces(const track::Track& track, const PrintRequest& request,
                                                    const PrintMeans& means) {
    const track::PrintOptions options = toPrintOptions(request, means.limits);
    track::SplitOptions split;
    split.cuts = request.cuts;
    split.dowelWall = means.limits.thinnestWall;
    set(split.dowelDiameter, request.dowelDiameter, base::kMillimetre);
    set(split.dowelDepth, request.dowelDepth, base::kMillimetre);
    set(split.dowelClearance, request.dowelClearance, base::kMillimetre);
    if (request.split) {
        if (!means.printer)
            return Failure{ExitCode::usage,
                           "--split needs to know the bed: name it with --printer or --bed."};
        const auto cuts = track::proposeCuts(track, options, split, means.printer->space);
        if (!cuts) return Failure{ExitCode::usage, cuts.error().message};
        split.cuts = *cuts;
    }
    auto pieces = track::buildPrintPieces(track, options, split);
    if (!pieces) return Failure{ExitCode::usage, pieces.error().message};
    return std::move(*pieces);
}

std::string describeExport(const workflow::ExportedFile& file) {
    std::string text = fmt::format(
        "Wrote {}: {}{:.1f} x {:.1f} x {:.1f} mm, {} {}, {:.1f} cm^3, closed and manifold\n",
        file.path.string(), file.solids > 1 ? fmt::format("{} pieces, ", file.solids) : std::string(),
        file.size.x() * 1e3, file.size.y() * 1e3, file.size.z() * 1e3, file.faces,
        file.isStep ? "plane faces" : "triangles", file.volume * 1e6);
    if (file.overlappingTriangles > 0) {
        text += fmt::format(
            "{} of its triangles cross others: the surface overhangs itself there. Look at it before you "
            "print it.\n",
            file.overlappingTriangles);
    }
    return text;
}

std::string describeFlaws(const geometry::PrintReport& report) {
    std::string text;
    for (const geometry::ThinWall& wall : report.thinWalls) {
        text += fmt::format("Thin wall: {:.2f} mm, {:.1f} mm^2 at {}\n", wall.thickness * 1e3,
                            wall.area * 1e6, geometry::formatPlace(wall.centre));
    }
    for (const geometry::SharpRidge& ridge : report.ridges) {
        text += fmt::format(
            "Sharp ridge: {:.0f} degrees, {:.1f} mm long at {}; its last {:.1f} mm are too thin\n",
            ridge.angle / base::kDegree, ridge.length * 1e3, geometry::formatPlace(ridge.centre),
            ridge.lost * 1e3);
    }
    for (const geometry::Overhang& overhang : report.overhangs) {
        text += fmt::format("Overhang: {:.0f} degrees from upright, {:.1f} mm^2 at {}\n",
                            overhang.angle / base::kDegree, overhang.area * 1e6,
                            geometry::formatPlace(overhang.centre));
    }
    return text;
}

nlohmann::ordered_json flawsToJson(const geometry::PrintReport& report) {
    using Json = nlohmann::ordered_json;
    Json walls = Json::array();
    for (const geometry::ThinWall& wall : report.thinWalls) {
        walls.push_back({{"thickness_mm", wall.thickness * 1e3},
                         {"area_mm2", wall.area * 1e6},
                         {"centre_mm", toJson(wall.centre, 1e3)}});
    }
    Json ridges = Json::array();
    for (const geometry::SharpRidge& ridge : report.ridges) {
        ridges.push_back({{"angle_deg", ridge.angle / base::kDegree},
                          {"length_mm", ridge.length * 1e3},
                          {"too_thin_mm", ridge.lost * 1e3},
                          {"centre_mm", toJson(ridge.centre, 1e3)}});
    }
    Json overhangs = Json::array();
    for (const geometry::Overhang& overhang : report.overhangs) {
        overhangs.push_back({{"triangles", overhang.triangles.size()},
                             {"angle_deg", overhang.angle / base::kDegree},
                             {"area_mm2", overhang.area * 1e6},
                             {"centre_mm", toJson(overhang.centre, 1e3)}});
    }
    return {{"thin_walls", walls}, {"sharp_ridges", ridges}, {"overhangs", overhangs}};
}

std::string describeFit(std::span<const track::PrintPiece> pieces, const track::Printer& printer) {
    std::string text;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const geometry::BedFit fit = geometry::fitOnBed(pieces[i].solid, printer.space);
        const std::string what =
            pieces.size() == 1 ? "The track" : fmt::format("Piece {} of {}", i + 1, pieces.size());
        text += fmt::format(
            "{}, turned {:.0f} degrees, takes {:.1f} x {:.1f} x {:.1f} mm: {} the printer's {}\n", what,
            fit.turn / base::kDegree, fit.size.x() * 1e3, fit.size.y() * 1e3, fit.size.z() * 1e3,
            fit.fits ? std::string("fits into") : describeExcess(fit) + " for",
            track::formatSpace(printer.space));
    }
    return text;
}

nlohmann::ordered_json fitToJson(std::span<const track::PrintPiece> pieces, const track::Printer& printer) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const track::PrintPiece& piece : pieces) {
        const geometry::BedFit fit = geometry::fitOnBed(piece.solid, printer.space);
        list.push_back({{"first_section", piece.sections.first},
                        {"last_section", piece.sections.last},
                        {"dowel_holes", piece.holes.size()},
                        {"fits", fit.fits},
                        {"turn_deg", fit.turn / base::kDegree},
                        {"size_mm", toJson(fit.size, 1e3)},
                        {"too_large_mm", toJson(fit.excess, 1e3)}});
    }
    return list;
}

}  // namespace trapwright::app
