#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/math.h"
#include "core/geometry/mesh_check.h"
#include "core/store/study_file.h"
#include "core/study/settings.h"
#include "core/workflow/failure.h"

namespace trapwright::workflow {

/// How the user names a part and tells what its file does not.
struct PartRequest {
    std::string part;                       // bundled name or file
    std::optional<std::string> units{};     // of the file
    std::optional<double> density{};        // [kg/m^3]; goes before the material
    std::string materialName{};             // that goes with this density
    std::optional<std::string> material{};  // by name (part::readMaterials)
    std::filesystem::path ownMaterials{};   // the user's folder of them, if he has one
    std::optional<double>
        tolerance{};  // of the symmetry, as a share of the part's size; as new studies have it
    part::SymmetryUse symmetry = part::SymmetryUse::found;
    double defaultDensity = study::PartSettings{}.density;  // where none is named, nor the part bundled
    bool closeLargeHoles = false;  // that importing would otherwise refuse (geometry::kLargestHole)
};

/// A unit that a file could be in, and the size that the part would have.
struct UnitCandidate {
    std::string name;                      // um, mm, cm, m, inch or ft
    base::Vec3 size = base::Vec3::Zero();  // [m]
};

/// A part that was imported, ready to be put into a study.
struct LoadedPart {
    store::StoredPart stored;      // the mesh as imported
    study::PartSettings settings;  // where it comes from
    std::shared_ptr<const part::Part> part;
    bool bundled = false;
    bool unitsFromFile = false;             // the file or its format says the unit
    std::vector<UnitCandidate> candidates;  // all units, with the part's size under each
    geometry::MeshReport found;             // what was wrong with the mesh as imported
    std::vector<std::string> notes;         // what was found and mended
};

/// Why a part could not be imported, and what the user can do about it in a window.
struct PartFailure {
    Failure failure;
    std::vector<UnitCandidate> candidates{};         // if only its unit is missing
    std::optional<geometry::MeshReport> mendable{};  // if closing its large holes would make it a solid
};

/// Imports and builds a part; `tellStage` is called with what begins, such as "reading the file". Files of
/// others are for importPartApart (part_process.h).
base::Result<LoadedPart, PartFailure> importPart(const PartRequest& request,
                                                 const std::function<void(std::string_view)>& tellStage = {});

}  // namespace trapwright::workflow
