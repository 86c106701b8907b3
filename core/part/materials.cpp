#include "core/part/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>
#include <tuple>

#include "core/base/file.h"
#include "core/base/json_object.h"
#include "core/base/resources.h"

namespace trapwright::part {

namespace {

using base::Json;
using base::JsonObject;
using base::JsonProblem;

constexpr std::string_view kFormat = "trapwright material";
constexpr int kVersion = 1;

/// A number of a pair: its key in files, its name for people and its range.
struct NumberKey {
    const char* key;
    const char* title;
    MaterialNumber MaterialPair::*number;
    double low;
    double high;
};

// The ranges are those of the settings that the numbers go to.
constexpr NumberKey kDensity = {"density_kg_m3", "density", &MaterialPair::density, 1.0, 30000.0};
constexpr NumberKey kContact[] = {
    {"staticFriction", "static friction", &MaterialPair::staticFriction, 0.0, 2.0},
    {"kineticFriction", "kinetic friction", &MaterialPair::kineticFriction, 0.0, 2.0},
    {"restitution", "restitution", &MaterialPair::restitution, 0.0, 1.0}};

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// Lower case, and dashes for all that is neither letter nor digit.
std::string toSlug(std::string_view text) {
    std::string slug;
    for (const char c : lower(text)) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || byte >= 0x80) {
            slug += c;
        } else if (!slug.empty() && slug.back() != '-') {
            slug += '-';
        }
    }
    while (slug.ends_with('-'))
        slug.pop_back();
    return slug;
}

void readNumber(JsonObject& parent, const NumberKey& key, MaterialPair& pair) {
    const Json* json = parent.take(key.key);
    if (json == nullptr) return parent.need(key.key);
    JsonObject object(*json, parent.pathOf(key.key), parent.problem());
    MaterialNumber& number = pair.*key.number;
    if (!object.json().is_object()) return;
    if (!object.has("value")) object.need("value");
    object.number("value", number.value, key.low, key.high);
    object.number("spread", number.spread, 0.0, key.high);
    object.text("source", number.source, true);
    object.close();
}

std::vector<MaterialPair> readAll(const Json& json, const std::string& stem, JsonProblem& problem) {
    JsonObject object(json, "", problem);
    std::string format;
    object.text("format", format, true);
    if (format != kFormat) object.fail("format", fmt::format("this must be \"{}\"", kFormat));
    int version = 0;
    object.whole("version", version, 0, 1000);
    if (version != kVersion) {
        object.fail("version",
                    fmt::format("this must be {}, the only one that this program knows", kVersion));
    }
    std::string name;
    object.text("name", name, true);
    if (name != stem) {
        object.fail("name",
                    fmt::format("\"{}\" is not the file's name without .json; rename one of them", name));
    }
    MaterialPair common;
    object.text("material", common.material, true);
    readNumber(object, kDensity, common);

    std::vector<MaterialPair> pairs;
    if (const Json* list = object.take("pairs"); list != nullptr && !list->is_array()) {
        object.fail("pairs", "this is no list; write [ { ... }, { ... } ]");
    } else if (list != nullptr) {
        for (const Json& item : *list) {
            JsonObject entry(item, fmt::format("pairs[{}]", pairs.size()), problem);
            MaterialPair pair = common;
            entry.text("surface", pair.surface, true);
            for (const NumberKey& key : kContact)
                readNumber(entry, key, pair);
            if (pair.kineticFriction.value > pair.staticFriction.value) {
                entry.fail("kineticFriction", "this is above the static friction; it must not be");
            }
            entry.close();
            pair.name = pairName(pair.material, pair.surface);
            pairs.push_back(std::move(pair));
        }
    }
    object.close();
    if (pairs.empty()) pairs.push_back(common);
    return pairs;
}

Json toJson(const MaterialNumber& number) {
    return {{"value", number.value}, {"spread", number.spread}, {"source", number.source}};
}

std::string writeText(const std::string& name, const std::vector<MaterialPair>& pairs) {
    Json list = Json::array();
    for (const MaterialPair& pair : pairs) {
        if (pair.surface.empty()) continue;
        Json entry = {{"surface", pair.surface}};
        for (const NumberKey& key : kContact)
            entry[key.key] = toJson(pair.*key.number);
        list.push_back(std::move(entry));
    }
    const Json json = {{"format", kFormat},
                       {"version", kVersion},
                       {"name", name},
                       {"material", pairs.front().material},
                       {kDensity.key, toJson(pairs.front().density)},
                       {"pairs", std::move(list)}};
    return json.dump(2) + "\n";
}

base::Status writePairs(const std::filesystem::path& file, const std::vector<MaterialPair>& pairs) {
    std::error_code failure;
    std::filesystem::create_directories(file.parent_path(), failure);
    return base::writeFile(file, writeText(file.stem().string(), pairs));
}

std::vector<std::filesystem::path> listFiles(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// Adds what a folder holds; an entry of the same name gives way.
void addFolder(const std::filesystem::path& folder, bool own, MaterialLibrary& library) {
    for (const std::filesystem::path& file : listFiles(folder)) {
        auto pairs = readMaterialFile(file);
        if (!pairs) {
            library.problems.push_back(pairs.error().message);
            continue;
        }
        const Material material{pairs->front().material, pairs->front().density};
        std::erase_if(library.materials,
                      [&](const Material& one) { return lower(one.name) == lower(material.name); });
        library.materials.push_back(material);
        for (MaterialPair& pair : *pairs) {
            if (pair.surface.empty()) continue;
            pair.own = own;
            std::erase_if(library.pairs, [&](const MaterialPair& one) { return one.name == pair.name; });
            library.pairs.push_back(std::move(pair));
        }
    }
}

}  // namespace

std::string pairName(std::string_view material, std::string_view surface) {
    return toSlug(material) + "-on-" + toSlug(surface);
}

std::string pairTitle(const MaterialPair& pair) {
    return pair.material + " on " + pair.surface;
}

std::string describeSources(const MaterialPair& pair) {
    std::vector<std::pair<std::string, std::string>> bySource;  // source, what is from it
    const auto add = [&](const NumberKey& key) {
        const std::string& source = (pair.*key.number).source;
        const auto found = std::find_if(bySource.begin(), bySource.end(),
                                        [&](const auto& one) { return one.first == source; });
        if (found == bySource.end()) {
            bySource.emplace_back(source, key.title);
        } else {
            found->second += std::string(", ") + key.title;
        }
    };
    for (const NumberKey& key : kContact)
        add(key);
    add(kDensity);
    std::string text;
    for (const auto& [source, what] : bySource)
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", what, source);
    return text;
}

base::Result<std::vector<MaterialPair>> readMaterialFile(const std::filesystem::path& file) {
    const auto text = base::readFile(file);
    if (!text) return text.error();
    const auto json = base::parseJson(*text);
    if (!json) return base::Error{fmt::format("{}: {}", file.string(), json.error().message)};
    JsonProblem problem;
    std::vector<MaterialPair> pairs = readAll(*json, file.stem().string(), problem);
    if (!problem.text.empty()) return base::Error{fmt::format("{}: {}", file.string(), problem.text)};
    for (MaterialPair& pair : pairs)
        pair.file = file;
    return pairs;
}

MaterialLibrary readMaterials(const std::filesystem::path& own) {
    MaterialLibrary library;
    addFolder(base::findResource("materials"), false, library);
    if (!own.empty()) addFolder(own, true, library);
    std::sort(library.materials.begin(), library.materials.end(),
              [](const Material& a, const Material& b) { return lower(a.name) < lower(b.name); });
    std::sort(library.pairs.begin(), library.pairs.end(), [](const MaterialPair& a, const MaterialPair& b) {
        return std::tuple(lower(a.material), lower(a.surface)) <
               std::tuple(lower(b.material), lower(b.surface));
    });
    return library;
}

const Material* findMaterial(const MaterialLibrary& library, std::string_view name) {
    const auto found = std::find_if(library.materials.begin(), library.materials.end(),
                                    [&](const Material& one) { return lower(one.name) == lower(name); });
    return found == library.materials.end() ? nullptr : &*found;
}

const MaterialPair* findPair(const MaterialLibrary& library, std::string_view name) {
    const auto found = std::find_if(library.pairs.begin(), library.pairs.end(),
                                    [&](const MaterialPair& one) { return one.name == lower(name); });
    return found == library.pairs.end() ? nullptr : &*found;
}

const MaterialPair* findPair(const MaterialLibrary& library, std::string_view material,
                             std::string_view surface) {
    return findPair(library, pairName(material, surface));
}

base::Result<MaterialPair> requirePair(const MaterialLibrary& library, std::string_view name) {
    if (const MaterialPair* pair = findPair(library, name)) return *pair;
    std::string names;
    for (const MaterialPair& pair : library.pairs)
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", pair.name);
    std::string text =
        fmt::format("There is no pair of materials named \"{}\". Choose one of {}.", name, names);
    for (const std::string& problem : library.problems)
        text += "\nNot read: " + problem;
    return base::Error{text};
}

std::vector<std::string> findProblems(const MaterialPair& pair) {
    std::vector<std::string> problems;
    if (toSlug(pair.material).empty()) problems.emplace_back("The material has no name.");
    if (toSlug(pair.surface).empty()) problems.emplace_back("The surface has no name.");
    const auto check = [&](const NumberKey& key) {
        const MaterialNumber& number = pair.*key.number;
        if (!(number.value >= key.low && number.value <= key.high)) {
            problems.push_back(fmt::format("The {} is {}; it must be within {} and {}.", key.title,
                                           number.value, key.low, key.high));
        }
        if (!(number.spread >= 0.0 && number.spread <= key.high)) {
            problems.push_back(fmt::format("The spread of the {} is {}; it must be within 0 and {}.",
                                           key.title, number.spread, key.high));
        }
        if (number.source.empty()) {
            problems.push_back(
                fmt::format("The {} has no source; write \"assumed\" if there is none.", key.title));
        }
    };
    for (const NumberKey& key : kContact)
        check(key);
    check(kDensity);
    if (pair.kineticFriction.value > pair.staticFriction.value)
        problems.emplace_back("The kinetic friction is above the static friction; it must not be.");
    return problems;
}

base::Status savePair(const std::filesystem::path& own, const MaterialPair& pair,
                      const std::optional<MaterialPair>& before) {
    if (const auto problems = findProblems(pair); !problems.empty()) {
        std::string text;
        for (const std::string& problem : problems)
            text += (text.empty() ? "" : " ") + problem;
        return base::Error{text};
    }
    const std::string name = pairName(pair.material, pair.surface);
    MaterialLibrary library;
    addFolder(own, true, library);
    const bool replaces = before && before->own;
    if (const MaterialPair* other = findPair(library, name);
        other != nullptr && !(replaces && before->name == name)) {
        return base::Error{
            fmt::format("{} is there already, in {}. Edit that one, or name the surface "
                        "differently.",
                        pairTitle(*other), other->file.string())};
    }
    if (!replaces) return writePairs(own / (name + ".json"), {pair});
    auto pairs = readMaterialFile(before->file);
    if (!pairs) return pairs.error();
    for (MaterialPair& one : *pairs) {
        // The file has one material.
        one.material = pair.material;
        one.density = pair.density;
        if (one.name == before->name) one = pair;
    }
    return writePairs(before->file, *pairs);
}

base::Status removePair(const MaterialPair& pair) {
    auto pairs = readMaterialFile(pair.file);
    if (!pairs) return pairs.error();
    std::erase_if(*pairs, [&](const MaterialPair& one) { return one.name == pair.name; });
    if (!pairs->empty()) return writePairs(pair.file, *pairs);
    std::error_code failure;
    if (!std::filesystem::remove(pair.file, failure) || failure) {
        return base::Error{fmt::format("{} could not be removed: {}", pair.file.string(), failure.message())};
    }
    return base::success();
}

base::Result<std::vector<MaterialPair>> importPairs(const std::filesystem::path& file,
                                                    const std::filesystem::path& own, bool replace) {
    auto pairs = readMaterialFile(file);
    if (!pairs) return pairs.error();
    const std::filesystem::path target = own / file.filename();
    std::error_code failure;
    if (!replace && std::filesystem::exists(target, failure)) {
        return base::Error{
            fmt::format("{} is there already. Remove it, or rename the file that comes in and "
                        "the \"name\" in it.",
                        target.string())};
    }
    if (const auto written = writePairs(target, *pairs); !written) return written.error();
    for (MaterialPair& pair : *pairs) {
        pair.file = target;
        pair.own = true;
    }
    return pairs;
}

}  // namespace trapwright::part
