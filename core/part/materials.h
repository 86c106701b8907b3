#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace trapwright::part {

/// A number of the library, how far it may be off, and where it is from.
struct MaterialNumber {
    double value = 0.0;
    double spread = 0.0;             // half of the range in which it is found, in the value's unit
    std::string source = "assumed";  // a reference; "assumed" where there is none

    friend bool operator==(const MaterialNumber&, const MaterialNumber&) = default;
};

/// What a part is made of.
struct Material {
    std::string name;        // "ABS"
    MaterialNumber density;  // [kg/m^3]

    friend bool operator==(const Material&, const Material&) = default;
};

/// A material of parts on a surface of tracks.
struct MaterialPair {
    std::string name;      // "abs-on-printed-plastic" (pairName)
    std::string material;  // "ABS"
    std::string surface;   // "printed plastic"
    MaterialNumber density;
    MaterialNumber staticFriction;
    MaterialNumber kineticFriction;
    MaterialNumber restitution;
    bool own = false;            // the user's, not one that comes with Trapwright
    std::filesystem::path file;  // that holds it

    friend bool operator==(const MaterialPair&, const MaterialPair&) = default;
};

/// Materials and pairs that can be chosen, and what is wrong with files that could not be read.
struct MaterialLibrary {
    std::vector<Material> materials;    // by name
    std::vector<MaterialPair> pairs;    // by material, then surface
    std::vector<std::string> problems;  // each names its file, the place in it and what to do
};

/// The name of a pair: "ABS" and "printed plastic" give "abs-on-printed-plastic".
std::string pairName(std::string_view material, std::string_view surface);
/// "ABS on printed plastic"
std::string pairTitle(const MaterialPair& pair);
/// Where all four numbers of a pair are from: one sentence for people.
std::string describeSources(const MaterialPair& pair);

/// The materials that come with Trapwright (resources/materials) and those of the user's own folder, if there
/// is one. Of two pairs or materials with one name the user's counts. A file that cannot be read is a
/// problem of the library and hides no other file.
MaterialLibrary readMaterials(const std::filesystem::path& own = {});

/// One file's pairs; one without pairs gives its density in a pair without surface. Error: the file, the key
/// that is wrong, and what must stand there.
base::Result<std::vector<MaterialPair>> readMaterialFile(const std::filesystem::path& file);

/// By name, in any case. None if there is none.
const Material* findMaterial(const MaterialLibrary& library, std::string_view name);
const MaterialPair* findPair(const MaterialLibrary& library, std::string_view name);
/// The pair of this material and surface; the surface may be written as in pair names ("printed-plastic").
const MaterialPair* findPair(const MaterialLibrary& library, std::string_view material,
                             std::string_view surface);
/// Error: which names there are.
base::Result<MaterialPair> requirePair(const MaterialLibrary& library, std::string_view name);

/// Every number out of its range, as sentences; empty if all is well.
std::vector<std::string> findProblems(const MaterialPair& pair);

/// Keeps a pair of the user's in his folder: in the place of `before` in its file, if that is one of his,
/// else in a file of its own. Error: what is wrong with the pair, or why its file cannot be written.
base::Status savePair(const std::filesystem::path& own, const MaterialPair& pair,
                      const std::optional<MaterialPair>& before = std::nullopt);
/// Takes a pair of the user's out of its file; a file without another pair is removed.
base::Status removePair(const MaterialPair& pair);
/// Copies a file of pairs into the user's folder, if it can be read; gives its pairs. Error also where a file
/// of that name is there already, unless it may be replaced.
base::Result<std::vector<MaterialPair>> importPairs(const std::filesystem::path& file,
                                                    const std::filesystem::path& own, bool replace = false);

}  // namespace trapwright::part
