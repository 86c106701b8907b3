#include "app/trapwright/part_source.h"

#include "app/trapwright/work_failure.h"

namespace trapwright::app {

void addPartOptions(CLI::App& command, PartRequest& request) {
    command.add_option("--units", request.units, "Unit of the part's file: um, mm, cm, m, inch or ft");
    auto* density = command.add_option("--density", request.density, "Density of the part in kg/m^3");
    command.add_option("--material", request.material, "Density by material: ABS, steel, brass ...")
        ->excludes(density);
    command.add_option("--symmetry-tolerance", request.tolerance,
                       "How far a symmetric part may be from it, as a share of its size (default 0.01)");
}

Attempt<LoadedPart> loadPart(const PartRequest& request) {
    auto loaded = work::importPart(request);
    if (!loaded) return toFailure(loaded.error().failure);
    return std::move(*loaded);
}

}  // namespace trapwright::app
