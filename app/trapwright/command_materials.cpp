#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/trapwright/command.h"
#include "app/trapwright/part_source.h"
#include "core/part/materials.h"

namespace trapwright::app {

namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

nlohmann::ordered_json toJson(const part::MaterialNumber& number) {
    return {{"value", number.value}, {"spread", number.spread}, {"source", number.source}};
}

nlohmann::ordered_json toJson(const part::MaterialPair& pair) {
    return {{"name", pair.name},
            {"material", pair.material},
            {"surface", pair.surface},
            {"density_kg_m3", toJson(pair.density)},
            {"staticFriction", toJson(pair.staticFriction)},
            {"kineticFriction", toJson(pair.kineticFriction)},
            {"restitution", toJson(pair.restitution)},
            {"own", pair.own},
            {"file", pair.file.string()}};
}

std::string describe(const part::MaterialNumber& number) {
    return fmt::format("{:.2f} +-{:.2f}", number.value, number.spread);
}

Attempt<ExitCode> run(const std::string& wanted, const Console& console) {
    const part::MaterialLibrary library = part::readMaterials(findOwnMaterials());
    for (const std::string& problem : library.problems)
        console.note("Not read: " + problem);
    nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
    std::string text = fmt::format("{:<42} {:>12} {:>12} {:>12} {:>8}  {}\n", "Pair", "Static", "Kinetic",
                                   "Restitution", "kg/m^3", "Sources");
    for (const part::MaterialPair& pair : library.pairs) {
        if (lower(pair.name + " " + part::pairTitle(pair)).find(lower(wanted)) == std::string::npos) continue;
        pairs.push_back(toJson(pair));
        text += fmt::format("{:<42} {:>12} {:>12} {:>12} {:>8.0f}  {}{}\n", pair.name,
                            describe(pair.staticFriction), describe(pair.kineticFriction),
                            describe(pair.restitution), pair.density.value, pair.own ? "your own; " : "",
                            part::describeSources(pair));
    }
    if (pairs.empty()) {
        return Failure{ExitCode::usage,
                       fmt::format("No pair of materials has \"{}\" in its name; `trapwright materials` "
                                   "without a word lists them all.",
                                   wanted)};
    }
    console.print(text);
    console.emit(
        {{"ownFolder", findOwnMaterials().string()}, {"pairs", pairs}, {"notRead", library.problems}});
    return ExitCode::ok;
}

}  // namespace

void addMaterialsCommand(CLI::App& program, Invocation& invocation) {
    const auto wanted = std::make_shared<std::string>();
    Command command = addCommand(program, invocation, "materials",
                                 "Lists the pairs of part materials and track surfaces: friction, "
                                 "restitution and density, with spread and source.",
                                 "trapwright materials steel",
                                 [wanted](const Console& console) { return run(*wanted, console); });
    command.addOption("WORD", *wanted, "Only pairs with this in their name, as in pom or steel-sheet");
}

}  // namespace trapwright::app
