#include "app/trapwright/part_source.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/part/bundled.h"
#include "core/part/import.h"
#include "core/part/materials.h"

namespace trapwright::app {

namespace {

Attempt<double> findDensity(const std::string& material) {
    if (const auto found = part::findMaterial(material)) return found->density;
    std::string known;
    for (const part::Material& one : part::listMaterials())
        known += fmt::format("{}{}", known.empty() ? "" : ", ", one.name);
    return Failure{ExitCode::usage,
                   fmt::format("There is no material named \"{}\". The materials are {}; or give the "
                               "density itself with --density.",
                               material, known)};
}

bool looksLikeFile(const std::string& text) {
    std::error_code failure;
    return std::filesystem::exists(text, failure) || text.find('.') != std::string::npos ||
           text.find('/') != std::string::npos;
}

}  // namespace

void addPartOptions(CLI::App& command, PartRequest& request) {
    command.add_option("--units", request.units, "Unit of the part's file: um, mm, cm, m, inch or ft");
    auto* density = command.add_option("--density", request.density, "Density of the part in kg/m^3");
    command.add_option("--material", request.material, "Density by material: ABS, steel, brass ...")
        ->excludes(density);
    command.add_option("--symmetry-tolerance", request.tolerance,
                       "How far a symmetric part may be from it, as a share of its size (default 0.01)");
}

Attempt<LoadedPart> loadPart(const PartRequest& request, double defaultDensity) {
    LoadedPart loaded;
    std::filesystem::path path = request.part;
    std::optional<std::string> material = request.material;
    std::optional<std::string> units = request.units;
    if (const auto bundled = part::findBundledPart(request.part)) {
        path = part::findBundledFile(*bundled);
        loaded.file = request.part;
        loaded.bundled = true;
        loaded.options.name = request.part;
        if (!material) material = std::string(bundled->material);
        if (!units) units = "mm";  // which STL cannot say
    } else if (looksLikeFile(request.part)) {
        loaded.file = std::filesystem::absolute(path).lexically_normal().string();
        loaded.options.name = path.stem().string();
    } else {
        return Failure{ExitCode::badInput,
                       fmt::format("There is no file {0}, and {1}.", request.part, bundled.error().message)};
    }
    loaded.options.source = loaded.file;
    loaded.options.density = defaultDensity;
    if (request.density) {
        loaded.options.density = *request.density;
    } else if (material) {
        auto density = findDensity(*material);
        if (!density) return density.failure();
        loaded.options.density = *density;
    }
    if (request.tolerance) loaded.options.symmetryTolerance = *request.tolerance;

    auto imported = part::importMesh(path, units);
    if (!imported) return Failure{ExitCode::badInput, imported.error().message};
    auto prepared = part::buildPart(imported->mesh, loaded.options);
    if (!prepared) return Failure{ExitCode::badInput, path.string() + ": " + prepared.error().message};
    loaded.mesh = std::move(imported->mesh);
    loaded.units = imported->units;
    loaded.part = std::move(prepared->part);
    loaded.notes = std::move(imported->notes);
    loaded.notes.insert(loaded.notes.end(), prepared->notes.begin(), prepared->notes.end());
    return loaded;
}

}  // namespace trapwright::app
