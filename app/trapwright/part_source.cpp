#include "app/trapwright/part_source.h"

#include <fmt/format.h>

#include <mutex>
#include <string>
#include <string_view>

#include "app/trapwright/study_jobs.h"
#include "app/trapwright/work_display.h"
#include "core/base/resources.h"
#include "core/study/presets.h"
#include "core/workflow/part_process.h"

namespace trapwright::app {

void addPartOptions(Command command, PartRequest& request) {
    command.addOption("--units", request.units, "Unit of the part's file: um, mm, cm, m, inch or ft");
    const Option density = command.addOption("--density", request.density, "Density of the part in kg/m^3");
    request.ownMaterials = findOwnMaterials();
    command
        .addOption("--material", request.material,
                   "What the part is made of, for its density: ABS, steel, brass ... `trapwright materials` "
                   "lists them")
        .excludes(density);
    command.addOption("--symmetry-tolerance", request.tolerance,
                      "How far a symmetric part may be from it, as a share of its size (default 0.01)");
}

std::filesystem::path findOwnMaterials() {
    return base::findOwnFolder("materials");
}

Attempt<part::MaterialPair> findPair(const std::string& surface, const LoadedPart& loaded) {
    const part::MaterialLibrary library = part::readMaterials(findOwnMaterials());
    const part::Material* material = study::findUsedMaterial(library, loaded.settings);
    if (material == nullptr) {
        return Failure{
            ExitCode::usage,
            fmt::format("--surface {}: the library has no material of {} kg/m^3; name the part's with "
                        "--material, or set friction and restitution themselves.",
                        surface, loaded.settings.density)};
    }
    if (const auto* pair = part::findPair(library, material->name, surface)) return *pair;
    std::string known;
    for (const part::MaterialPair& pair : library.pairs) {
        if (pair.material == material->name) known += (known.empty() ? "" : ", ") + pair.surface;
    }
    for (const std::string& problem : library.problems)
        known += "; not read: " + problem;
    return Failure{ExitCode::usage,
                   fmt::format("There is no surface named \"{}\" for {}. The surfaces are {}.", surface,
                               material->name, known)};
}

Attempt<LoadedPart> loadPart(const PartRequest& request, const Console& console) {
    std::mutex mutex;
    std::string stage = "starting";
    base::RunControl control;
    const auto progress = [&] {
        const std::lock_guard lock(mutex);
        return fmt::format("{}: {}", std::filesystem::path(request.part).filename().string(), stage);
    };
    const auto tellStage = [&](std::string_view text) {
        const std::lock_guard lock(mutex);
        stage = text;
    };
    const WorkDisplay display(console, {progress, [&](int /*count*/) { control.cancel(); }});
    auto loaded = workflow::importPartApart(request, control, tellStage);
    if (!loaded) return toFailure(loaded.error().failure);
    return std::move(*loaded);
}

}  // namespace trapwright::app
