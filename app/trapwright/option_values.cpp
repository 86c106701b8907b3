#include "app/trapwright/option_values.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/part/bundled.h"
#include "core/part/import.h"
#include "core/part/materials.h"
#include "core/part/units.h"
#include "core/study/presets.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

using Paths = ValueKind::Paths;

/// What an option takes, in one command or, where none is named, in all of them.
struct Use {
    std::string_view command;
    std::string_view option;
    std::string_view type;
};

constexpr std::array<Use, 24> kUses = {{
    {"", "STUDY", "STUDY"},
    {"dump", "--compare", "STUDY"},
    {"part", "FILE", "PART"},
    {"", "--part", "PART"},
    {"track", "FILE", "TRACK"},
    {"export", "STUDY|TRACK", "STUDY|TRACK"},
    {"robustness", "FILE", "STUDY|TRACK"},
    {"stream", "FILE", "STUDY|TRACK"},
    {"evolve", "--behind", "STUDY|TRACK"},
    {"", "--settings", "JSON"},
    {"export", "FILE", "FILE"},
    {"replay", "--out", "FILE"},
    {"demo", "--out", "FOLDER"},
    {"", "--preset", "PRESET"},
    {"", "--contact", "PAIR"},
    {"", "--engine", "ENGINE"},
    {"", "--material", "MATERIAL"},
    {"", "--surface", "SURFACE"},
    {"", "--units", "UNIT"},
    {"materials", "WORD", "WORD"},
    {"", "--set", kSettingType},
    // What nobody can complete, but what has a better name than TEXT.
    {"verify", "--case", "NAME"},
    {"bench", "--scene", "NAME"},
    {"replay", "--kind", "KIND"},
}};

template <class Range, class Projection>
std::vector<std::string> collectNames(const Range& range, Projection name) {
    std::vector<std::string> names;
    names.reserve(std::size(range));
    for (const auto& one : range)
        names.emplace_back(name(one));
    return names;
}

std::vector<std::string> studyEngineNames() {
    std::vector<std::string> names =
        collectNames(engines::registry().kinds(), [](const trial::EngineKind& kind) { return kind.name; });
    names.emplace_back(trial::kHybrid);
    return names;
}

/// As they stand in the names of pairs, without spaces.
std::vector<std::string> surfaceNames(const part::MaterialLibrary& library) {
    std::vector<std::string> names;
    for (const part::MaterialPair& pair : library.pairs) {
        const std::string name = pair.name.substr(pair.name.find("-on-") + 4);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

std::vector<std::string> partExtensions() {
    std::vector<std::string> extensions = part::supportedExtensions();
    for (std::string& extension : extensions)
        extension.erase(0, 1);
    return extensions;
}

}  // namespace

std::vector<ValueKind> listValueKinds() {
    // What comes with the program: a completion is made once for all users.
    const part::MaterialLibrary library = part::readMaterials();
    return {
        {"STUDY", {}, Paths::files, {"trap"}},
        {"PART",
         collectNames(part::listBundledParts(), [](const part::BundledPart& part) { return part.name; }),
         Paths::files, partExtensions()},
        {"TRACK", {}, Paths::files, {"json"}},
        {"STUDY|TRACK", {}, Paths::files, {"trap", "json"}},
        {"JSON", {}, Paths::files, {"json"}},
        {"FILE", {}, Paths::files, {}},
        {"FOLDER", {}, Paths::folders, {}},
        {"PRESET", collectNames(study::presetNames(), [](std::string_view name) { return name; })},
        {"PAIR", collectNames(library.pairs, [](const auto& pair) { return pair.name; })},
        {"ENGINE", studyEngineNames()},
        {"MATERIAL", collectNames(library.materials, [](const auto& material) { return material.name; })},
        {"SURFACE", surfaceNames(library)},
        {"UNIT", {"um", "mm", "cm", "m", "inch", "ft"}},
        {"KIND", {"learning", "selection", "validation"}},
    };
}

std::optional<std::string> findValueType(const CLI::App& command, const CLI::Option& option) {
    const std::string name = option.get_name();
    const auto found = std::ranges::find_if(kUses, [&](const Use& use) {
        return use.option == name && (use.command.empty() || use.command == command.get_name());
    });
    if (found == kUses.end()) return std::nullopt;
    return std::string(found->type);
}

void nameValueTypes(CLI::App& program) {
    for (CLI::App* command : program.get_subcommands({})) {
        for (CLI::Option* option : command->get_options()) {
            if (const auto type = findValueType(*command, *option)) option->type_name(*type);
        }
    }
}

}  // namespace trapwright::app
