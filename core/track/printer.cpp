#include "core/track/printer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/base/file.h"
#include "core/base/json_object.h"
#include "core/base/resources.h"

namespace trapwright::track {

namespace {

using base::JsonObject;
using base::kDegree;
using base::kMillimetre;

constexpr const char* kFormat = "trapwright printer";
constexpr int kVersion = 1;

std::filesystem::path fileOf(const std::filesystem::path& folder, const std::string& name) {
    return folder / (name + ".json");
}

base::Result<Printer> readPrinterFile(const std::filesystem::path& file) {
    const auto text = base::readFile(file);
    if (!text) return text.error();
    auto printer = readPrinter(*text);
    if (!printer) return base::Error{fmt::format("{}: {}", file.string(), printer.error().message)};
    return printer;
}

void addFolder(const std::filesystem::path& folder, bool own, PrinterList& list) {
    std::error_code failure;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
        auto printer = readPrinterFile(file);
        if (!printer) {
            list.problems.push_back(printer.error().message);
        } else if (printer->name != file.stem().string()) {
            list.problems.push_back(fmt::format(
                "{}: at \"name\": \"{}\" is not the file's name without .json; rename one of them",
                file.string(), printer->name));
        } else {
            printer->own = own;
            std::erase_if(list.printers, [&](const Printer& other) { return other.name == printer->name; });
            list.printers.push_back(std::move(*printer));
        }
    }
}

}  // namespace

std::string formatSpace(const geometry::BuildSpace& space) {
    return fmt::format("{:g} x {:g} x {:g} mm", space.x / kMillimetre, space.y / kMillimetre,
                       space.height / kMillimetre);
}

base::Result<Printer> readPrinter(std::string_view json) {
    const auto read = base::parseJson(json);
    if (!read) return read.error();
    base::JsonProblem problem;
    Printer printer;
    JsonObject object(*read, "", problem);
    std::string format;
    object.text("format", format, true);
    if (format != kFormat) object.fail("format", fmt::format("this must be \"{}\"", kFormat));
    int version = 0;
    object.whole("version", version, 0, 1'000'000);
    if (version != kVersion)
        object.fail("version",
                    fmt::format("this must be {}, the only one that this program knows", kVersion));
    object.text("name", printer.name, true);
    if (printer.name != nameOfTitle(printer.name))
        object.fail("name", "use small letters, digits and single dashes only, as in \"my-printer\"");
    object.text("title", printer.title, true);
    object.texts("sources", printer.sources);
    for (const char* key : {"bedX_mm", "bedY_mm", "height_mm"}) {
        if (!object.has(key)) object.need(key);
    }
    object.number("bedX_mm", printer.space.x, 10.0, 5000.0, kMillimetre);
    object.number("bedY_mm", printer.space.y, 10.0, 5000.0, kMillimetre);
    object.number("height_mm", printer.space.height, 10.0, 5000.0, kMillimetre);
    object.number("thinnestWall_mm", printer.thinnestWall, 0.05, 20.0, kMillimetre);
    object.number("steepestOverhang_deg", printer.steepestOverhang, 0.0, 90.0, kDegree);
    object.close();
    if (!problem.text.empty()) return base::Error{problem.text};
    return printer;
}

std::string printerToJson(const Printer& printer) {
    // Without the dust of the change of unit.
    const auto rounded = [](double value) { return std::round(value * 1e6) / 1e6; };
    base::Json json = {{"format", kFormat},
                       {"version", kVersion},
                       {"name", printer.name},
                       {"title", printer.title},
                       {"sources", printer.sources},
                       {"bedX_mm", rounded(printer.space.x / kMillimetre)},
                       {"bedY_mm", rounded(printer.space.y / kMillimetre)},
                       {"height_mm", rounded(printer.space.height / kMillimetre)},
                       {"thinnestWall_mm", rounded(printer.thinnestWall / kMillimetre)},
                       {"steepestOverhang_deg", rounded(printer.steepestOverhang / kDegree)}};
    return json.dump(4) + "\n";
}

PrinterList readPrinters(const std::filesystem::path& own) {
    PrinterList list;
    addFolder(base::findResource("printers"), false, list);
    if (!own.empty()) addFolder(own, true, list);
    std::sort(list.printers.begin(), list.printers.end(), [](const Printer& a, const Printer& b) {
        return std::pair(a.title, a.name) < std::pair(b.title, b.name);
    });
    return list;
}

base::Result<Printer> findPrinter(const PrinterList& list, std::string_view name) {
    std::string names;
    for (const Printer& printer : list.printers) {
        if (printer.name == name) return printer;
        names += (names.empty() ? "" : ", ") + printer.name;
    }
    return base::Error{fmt::format("There is no printer \"{}\"; there are: {}.", name, names)};
}

std::string nameOfTitle(std::string_view title) {
    std::string name;
    for (const char c : title) {
        const auto letter = static_cast<unsigned char>(c);
        if (letter < 0x80 && std::isalnum(letter) != 0) {
            name += static_cast<char>(std::tolower(letter));
        } else if (!name.empty() && name.back() != '-') {
            name += '-';
        }
    }
    while (name.ends_with('-'))
        name.pop_back();
    return name;
}

base::Status savePrinter(const std::filesystem::path& own, const Printer& printer) {
    const std::string text = printerToJson(printer);
    // What could not be read back is not written.
    if (const auto read = readPrinter(text); !read) return read.error();
    std::error_code failure;
    std::filesystem::create_directories(own, failure);
    return base::writeFile(fileOf(own, printer.name), text);
}

base::Result<Printer> importPrinter(const std::filesystem::path& file, const std::filesystem::path& own) {
    auto printer = readPrinterFile(file);
    if (!printer) return printer;
    std::error_code failure;
    if (std::filesystem::exists(fileOf(own, printer->name), failure)) {
        return base::Error{
            fmt::format("{}: you have a printer \"{}\" already; remove it, or give the new one "
                        "another name in its file.",
                        file.string(), printer->name)};
    }
    if (const auto saved = savePrinter(own, *printer); !saved) return saved.error();
    printer->own = true;
    return printer;
}

base::Status removePrinter(const std::filesystem::path& own, const std::string& name) {
    std::error_code failure;
    if (std::filesystem::remove(fileOf(own, name), failure)) return base::success();
    return base::Error{fmt::format("{} could not be removed: {}", fileOf(own, name).string(),
                                   failure ? failure.message() : "there is no such file")};
}

}  // namespace trapwright::track
