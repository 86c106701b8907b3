#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/bed_fit.h"
#include "core/geometry/print_check.h"

namespace trapwright::track {

/// A 3D printer as its owner knows it. One file of resources/printers (its README.md tells the keys), or of
/// the user's own folder.
struct Printer {
    std::string name;                    // "prusa-mk4", the file's name without .json
    std::string title;                   // for people
    std::vector<std::string> sources{};  // where the numbers are from, or "assumed: ..."
    geometry::BuildSpace space;
    double thinnestWall = geometry::PrintLimits{}.thinnestWall;          // [m]
    double steepestOverhang = geometry::PrintLimits{}.steepestOverhang;  // from upright [rad]
    bool own = false;  // the user's, not one that comes with Trapwright

    friend bool operator==(const Printer&, const Printer&) = default;
};

/// The printers of a folder and what is wrong with the files that could not be read.
struct PrinterList {
    std::vector<Printer> printers;      // by title
    std::vector<std::string> problems;  // each names its file, the key and what must stand there
};

/// "250 x 210 x 220 mm"
std::string formatSpace(const geometry::BuildSpace& space);

/// A printer from its file's text. Error: the first key that is wrong, and what must stand there.
base::Result<Printer> readPrinter(std::string_view json);
/// The same as the text of a file.
std::string printerToJson(const Printer& printer);

/// The printers that come with Trapwright and those of the user's own folder; of two with one name the user's
/// counts.
PrinterList readPrinters(const std::filesystem::path& own);
/// Error: which names there are.
base::Result<Printer> findPrinter(const PrinterList& list, std::string_view name);

/// A name for a file from a title: "My Printer 2" gives "my-printer-2"; empty if nothing of it can be kept.
std::string nameOfTitle(std::string_view title);
/// Keeps a printer in the user's own folder, in the place of one with its name. Error: what is wrong with it,
/// or why it cannot be written.
base::Status savePrinter(const std::filesystem::path& own, const Printer& printer);
/// Copies a file into the user's own folder, if it can be read. Error also where that name is taken there.
base::Result<Printer> importPrinter(const std::filesystem::path& file, const std::filesystem::path& own);
/// Takes a printer out of the user's own folder.
base::Status removePrinter(const std::filesystem::path& own, const std::string& name);

}  // namespace trapwright::track
