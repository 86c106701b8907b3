#include "core/workflow/part_source.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <limits>

#include "core/geometry/mesh_repair.h"
#include "core/part/bundled.h"
#include "core/part/import.h"
#include "core/part/materials.h"
#include "core/part/units.h"

namespace trapwright::workflow {

namespace {

constexpr std::array<const char*, 6> kUnits = {"um", "mm", "cm", "m", "inch", "ft"};

/// What is to be imported, before its file is opened.
struct PartSource {
    std::filesystem::path path;
    std::optional<std::string> units;
    std::optional<std::string> material;
    part::PartOptions options;
    bool bundled = false;
};

bool looksLikeFile(const std::string& text) {
    std::error_code failure;
    return std::filesystem::exists(text, failure) || text.find('.') != std::string::npos ||
           text.find('/') != std::string::npos;
}

Result<PartSource> findSource(const PartRequest& request) {
    PartSource source;
    source.path = request.part;
    source.units = request.units;
    source.material = request.material;
    if (const auto bundled = part::findBundledPart(request.part)) {
        source.path = part::findBundledFile(*bundled);
        source.options.source = request.part;
        source.options.name = request.part;
        source.bundled = true;
        if (!source.material) source.material = std::string(bundled->material);
        if (!source.units) source.units = "mm";  // which STL cannot say
    } else if (looksLikeFile(request.part)) {
        source.options.source = std::filesystem::absolute(source.path).lexically_normal().string();
        source.options.name = source.path.stem().string();
    } else {
        return Failure{FailureKind::reading,
                       fmt::format("There is no file {0}, and {1}.", request.part, bundled.error().message)};
    }
    return source;
}

/// The material, or a density without a name.
Result<part::Material> findMaterial(const PartRequest& request, const std::optional<std::string>& material) {
    if (request.density) return part::Material{request.materialName, {*request.density, 0.0, {}}};
    if (!material) return part::Material{{}, {request.defaultDensity, 0.0, {}}};
    const part::MaterialLibrary library = part::readMaterials(request.ownMaterials);
    if (const part::Material* found = part::findMaterial(library, *material)) return *found;
    std::string known;
    for (const part::Material& one : library.materials)
        known += fmt::format("{}{}", known.empty() ? "" : ", ", one.name);
    for (const std::string& problem : library.problems)
        known += "; not read: " + problem;
    return Failure{FailureKind::settings,
                   fmt::format("There is no material named \"{}\". The materials are {}; or give the "
                               "density itself with --density.",
                               *material, known)};
}

std::vector<UnitCandidate> listCandidates(const part::ImportedMesh& imported) {
    const base::Vec3 size = geometry::calcBoundingBox(imported.mesh).size();
    const auto present = part::findUnit(imported.units);
    std::vector<UnitCandidate> candidates;
    candidates.reserve(kUnits.size());
    for (const char* name : kUnits)
        candidates.push_back({name, size * (part::findUnit(name)->metres / present->metres)});
    return candidates;
}

/// Why a file cannot be imported. Where it can be as soon as its unit is known, the units that it could be
/// in.
PartFailure describeImport(const PartSource& source, const base::Error& error) {
    PartFailure why{{FailureKind::reading, error.message}};
    if (source.units) return why;
    if (const auto anyhow = part::importMesh(source.path, "mm")) why.candidates = listCandidates(*anyhow);
    return why;
}

/// Why no part can be made of a mesh. Where closing its holes makes it a solid, what is wrong with it.
PartFailure describeBuild(const PartSource& source, const geometry::TriangleMesh& mesh,
                          const base::Error& error) {
    PartFailure why{{FailureKind::reading, source.path.string() + ": " + error.message}};
    if (geometry::repairMesh(mesh).ok()) return why;
    if (geometry::repairMesh(mesh, std::numeric_limits<double>::infinity()).ok())
        why.mendable = geometry::checkMesh(mesh);
    return why;
}

}  // namespace

base::Result<LoadedPart, PartFailure> importPart(const PartRequest& request,
                                                 const std::function<void(std::string_view)>& tellStage) {
    const auto begin = [&](std::string_view stage) {
        if (tellStage) tellStage(stage);
    };
    auto source = findSource(request);
    if (!source) return PartFailure{source.error()};
    const auto material = findMaterial(request, source->material);
    if (!material) return PartFailure{material.error()};
    source->options.density = material->density.value;
    source->options.symmetryTolerance = request.tolerance.value_or(study::PartSettings{}.symmetryTolerance);
    source->options.symmetry = request.symmetry;

    begin("reading the file");
    auto imported = part::importMesh(source->path, source->units);
    if (!imported) return describeImport(*source, imported.error());
    LoadedPart loaded;
    loaded.candidates = listCandidates(*imported);
    begin("checking the mesh");
    loaded.found = geometry::checkMesh(imported->mesh);
    loaded.notes = std::move(imported->notes);
    if (request.closeLargeHoles) {
        auto closed = geometry::repairMesh(imported->mesh, std::numeric_limits<double>::infinity());
        if (!closed) return describeBuild(*source, imported->mesh, closed.error());
        imported->mesh = std::move(closed->mesh);
        loaded.notes.insert(loaded.notes.end(), closed->notes.begin(), closed->notes.end());
    }
    auto prepared = part::buildPart(imported->mesh, source->options, tellStage);
    if (!prepared) return describeBuild(*source, imported->mesh, prepared.error());
    loaded.notes.insert(loaded.notes.end(), prepared->notes.begin(), prepared->notes.end());
    loaded.part = std::make_shared<const part::Part>(std::move(prepared->part));
    loaded.bundled = source->bundled;
    loaded.unitsFromFile = imported->unitsFromFile;
    loaded.settings = {source->options.source,   imported->units,
                       source->options.density,  source->options.symmetryTolerance,
                       source->options.symmetry, material->name};
    loaded.stored = {std::move(imported->mesh), source->options};
    return loaded;
}

}  // namespace trapwright::workflow
