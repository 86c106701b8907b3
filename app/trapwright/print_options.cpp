#include "app/trapwright/print_options.h"

#include <fmt/format.h>

#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/trapwright/json_records.h"
#include "core/geometry/mesh_check.h"

namespace trapwright::app {

namespace {

constexpr const char* kGroup = "What is printed";

void set(double& target, const std::optional<double>& given, double unit) {
    if (given) target = *given * unit;
}

nlohmann::ordered_json listFlaws(const std::vector<geometry::PrintFlaw>& flaws, const char* worst,
                                 double unit) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const geometry::PrintFlaw& flaw : flaws) {
        list.push_back({{"triangles", flaw.triangles.size()},
                        {worst, flaw.worst / unit},
                        {"area_mm2", flaw.area * 1e6},
                        {"centre_mm", toJson(flaw.centre, 1e3)}});
    }
    return list;
}

}  // namespace

void addPrintOptions(CLI::App& command, PrintRequest& request) {
    const auto add = [&](const char* name, std::optional<double>& value, const char* help) {
        command.add_option(name, value, help)->type_name("MM")->group(kGroup);
    };
    add("--base-thickness", request.baseThickness, "Below the lowest valley (default: the study's)");
    add("--wall-height", request.wallHeight, "Of both side walls, above the highest hill (0: no walls)");
    add("--wall-thickness", request.wallThickness, "Of the side walls, at least (2)");
    command
        .add_flag(
            "--flange", request.flange,
            "A plate at the foot with bolt holes: at both sides of a linear feeder; in a bowl at the outer "
            "side, cut round so that it fits into the bowl")
        ->group(kGroup);
    add("--flange-thickness", request.flangeThickness, "At most the base thickness (3)");
    add("--bolt-diameter", request.boltDiameter, "Of the holes (4.5, for M4; 0: no holes)");
    add("--bolt-spacing", request.boltSpacing, "Between the holes' centres (50)");
    add("--bolt-edge-distance", request.boltEdgeDistance,
        "From the holes' centres to the flange's edge; the flange is twice as wide (8)");
    add("--insert-radius", request.insertRadius,
        "Of the bowl, where the flange is cut (0, the default: the least that leaves room)");
    add("--thinnest", request.thinnestWall, "Walls thinner than this are told of (1.2)");
    command
        .add_option("--steepest", request.steepestOverhang,
                    "Overhangs that lean further from upright are told of (45)")
        ->type_name("DEG")
        ->check(CLI::Range(0.0, 90.0))
        ->group(kGroup);
}

track::PrintOptions toPrintOptions(const PrintRequest& request) {
    track::PrintOptions options;
    if (request.baseThickness) options.baseThickness = *request.baseThickness * base::kMillimetre;
    options.flange = request.flange;
    set(options.wallHeight, request.wallHeight, base::kMillimetre);
    set(options.wallThickness, request.wallThickness, base::kMillimetre);
    set(options.flangeThickness, request.flangeThickness, base::kMillimetre);
    set(options.boltDiameter, request.boltDiameter, base::kMillimetre);
    set(options.boltSpacing, request.boltSpacing, base::kMillimetre);
    set(options.boltEdgeDistance, request.boltEdgeDistance, base::kMillimetre);
    set(options.insertRadius, request.insertRadius, base::kMillimetre);
    return options;
}

geometry::PrintLimits toPrintLimits(const PrintRequest& request) {
    geometry::PrintLimits limits;
    set(limits.thinnestWall, request.thinnestWall, base::kMillimetre);
    set(limits.steepestOverhang, request.steepestOverhang, base::kDegree);
    return limits;
}

std::string describeExport(const work::ExportedFile& file) {
    std::string text =
        fmt::format("Wrote {}: {:.1f} x {:.1f} x {:.1f} mm, {} triangles, {:.1f} cm^3, closed and manifold\n",
                    file.path.string(), file.size.x() * 1e3, file.size.y() * 1e3, file.size.z() * 1e3,
                    file.triangles, file.report.volume * 1e6);
    if (file.report.overlappingTriangles > 0) {
        text += fmt::format(
            "{} of its triangles cross others: the surface overhangs itself there. Look at it before you "
            "print it.\n",
            file.report.overlappingTriangles);
    }
    return text;
}

std::string describeFlaws(const geometry::PrintReport& report) {
    std::string text;
    for (const geometry::PrintFlaw& flaw : report.thinWalls) {
        text += fmt::format("Thin wall: {:.2f} mm, {:.1f} mm^2 at {}\n", flaw.worst * 1e3, flaw.area * 1e6,
                            geometry::formatPlace(flaw.centre));
    }
    for (const geometry::PrintFlaw& flaw : report.overhangs) {
        text += fmt::format("Overhang: {:.0f} degrees from upright, {:.1f} mm^2 at {}\n",
                            flaw.worst / base::kDegree, flaw.area * 1e6, geometry::formatPlace(flaw.centre));
    }
    return text;
}

nlohmann::ordered_json flawsToJson(const geometry::PrintReport& report) {
    return {{"thin_walls", listFlaws(report.thinWalls, "thickness_mm", base::kMillimetre)},
            {"overhangs", listFlaws(report.overhangs, "angle_deg", base::kDegree)}};
}

}  // namespace trapwright::app
