#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::part {

/// A part that comes with Trapwright.
struct BundledPart {
    std::string_view name;
    std::string_view file;         // in the folder parts/ of the resources, STL in mm
    std::string_view material;     // by default (see materials.h)
    std::string_view description;  // for people
};

/// The bundled parts, the two of the paper first.
std::span<const BundledPart> listBundledParts();

/// "cuboid, cone, ...": all names, for people.
std::string nameBundledParts();

/// The bundled part with this name. Error: there is none; names those that there are.
base::Result<BundledPart> findBundledPart(std::string_view name);

/// The shape of a bundled part as the generator writes it, by construction. Empty for an unknown name. [m]
geometry::TriangleMesh makeBundledShape(std::string_view name);

/// Where the part's file is (base::findResource).
std::filesystem::path findBundledFile(const BundledPart& part);

/// Parts without any symmetry, as most are in practice. Each is there as a STEP file, too: "clip.step".
inline constexpr std::array<std::string_view, 6> kPartsInStep = {"clip",    "wedge",         "plate",
                                                                 "d-shaft", "holed-bracket", "housing"};

/// The L bracket once more, as a STEP file.
inline constexpr std::string_view kBracketStepFile = "bracket.step";
/// Corners of the L bracket's profile, counter-clockwise, and its width; for the STEP file, too. [m]
std::span<const base::Vec2> bracketProfile();
double bracketWidth();

}  // namespace trapwright::part
