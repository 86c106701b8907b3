#pragma once

#include <CLI/App.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/geometry/print_check.h"
#include "core/track/print_solid.h"
#include "core/work/track_export.h"

namespace trapwright::app {

/// How a user tells what is printed, in mm and degrees. What is not given is as in track::PrintOptions.
struct PrintRequest {
    std::optional<double> baseThickness;
    std::optional<double> wallHeight;
    std::optional<double> wallThickness;
    bool flange = false;
    std::optional<double> flangeThickness;
    std::optional<double> boltDiameter;
    std::optional<double> boltSpacing;
    std::optional<double> boltEdgeDistance;
    std::optional<double> insertRadius;
    std::optional<double> thinnestWall;
    std::optional<double> steepestOverhang;
};

void addPrintOptions(CLI::App& command, PrintRequest& request);

track::PrintOptions toPrintOptions(const PrintRequest& request);
geometry::PrintLimits toPrintLimits(const PrintRequest& request);

/// A sentence about a file for people.
std::string describeExport(const work::ExportedFile& file);

/// What a printer may fail at, a line each; empty if there is nothing.
std::string describeFlaws(const geometry::PrintReport& report);
/// The same in mm and degrees.
nlohmann::ordered_json flawsToJson(const geometry::PrintReport& report);

}  // namespace trapwright::app
