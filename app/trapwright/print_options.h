#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/trapwright/exit_codes.h"
#include "app/trapwright/options.h"
#include "core/geometry/print_check.h"
#include "core/track/print_pieces.h"
#include "core/track/printer.h"
#include "core/workflow/track_export.h"

namespace trapwright::app {

/// How a user tells what is printed, in mm and degrees. What is not given is as in track::PrintOptions, a rim
/// as wide as the thinnest wall.
struct PrintRequest {
    std::optional<double> baseThickness;
    std::optional<double> wallHeight;
    std::optional<double> wallThickness;
    std::optional<double> rim;
    bool flange = false;
    std::optional<double> flangeThickness;
    std::optional<double> boltDiameter;
    std::optional<double> boltSpacing;
    std::optional<double> boltEdgeDistance;
    std::optional<double> insertRadius;
    std::string printer;  // its name; empty: none is meant
    std::string bed;      // "250x210x220"; empty: the printer's
    std::optional<double> thinnestWall;
    std::optional<double> steepestOverhang;
    std::vector<int> cuts;  // at these sections
    bool split = false;     // at the sections that the printer's bed makes necessary
    std::optional<double> dowelDiameter;
    std::optional<double> dowelDepth;
    std::optional<double> dowelClearance;
};

/// Adds --printer, --thinnest and --steepest.
void addPrinterOptions(Command command, PrintRequest& request);
/// Adds these and all else of a request.
void addPrintOptions(Command command, PrintRequest& request);

track::PrintOptions toPrintOptions(const PrintRequest& request, const geometry::PrintLimits& limits);

/// What the track is printed with.
struct PrintMeans {
    std::optional<track::Printer> printer;  // with the bed that was given; none: no bed is known
    geometry::PrintLimits limits;
};

/// The printer that is named, and what is said differently of it. Error: no such printer, or a bed that is
/// none.
Attempt<PrintMeans> findPrintMeans(const PrintRequest& request);

/// The pieces that are asked for. Error: they cannot be made.
Attempt<std::vector<track::PrintPiece>> buildPieces(const track::Track& track, const PrintRequest& request,
                                                    const PrintMeans& means);

/// A sentence about a file for people.
std::string describeExport(const workflow::ExportedFile& file);

/// What a printer may fail at, a line each; empty if there is nothing.
std::string describeFlaws(const geometry::PrintReport& report);
/// The same in mm and degrees.
nlohmann::ordered_json flawsToJson(const geometry::PrintReport& report);

/// Whether each piece fits on the bed, a line each.
std::string describeFit(std::span<const track::PrintPiece> pieces, const track::Printer& printer);
nlohmann::ordered_json fitToJson(std::span<const track::PrintPiece> pieces, const track::Printer& printer);

}  // namespace trapwright::app
