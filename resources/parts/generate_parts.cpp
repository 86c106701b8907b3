// Writes the bundled parts into the folder given as the only argument.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "core/geometry/mesh_files.h"
#include "core/part/bundled.h"
#include "core/part/cad_export.h"

namespace {

bool succeeded(const trapwright::base::Status& status) {
    if (!status) std::fprintf(stderr, "generate_parts: %s\n", status.error().message.c_str());
    return status.ok();
}

}  // namespace

int main(int argc, char** argv) {
    using namespace trapwright;
    if (argc != 2) {
        std::fprintf(stderr, "usage: generate_parts FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    for (const part::BundledPart& entry : part::listBundledParts()) {
        if (!succeeded(geometry::writeStl(folder / entry.file, part::makeBundledShape(entry.name)))) return 1;
    }
    for (const std::string_view name : part::kPartsInStep) {
        const std::filesystem::path step = folder / fmt::format("{}.step", name);
        if (!succeeded(part::writeStepSolid(step, part::makeBundledShape(name)))) return 1;
    }
    const std::filesystem::path step = folder / part::kBracketStepFile;
    return succeeded(part::writeStepPrism(step, part::bracketProfile(), part::bracketWidth())) ? 0 : 1;
}
