#include <cstddef>
#include <cstdint>

#include "core/part/materials.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// A file of materials: what is read has no problems and can be kept.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::ScratchFolder folder;
    static const fuzz::ScratchFolder own;
    const auto pairs = part::readMaterialFile(folder.keepOnly("pairs.json", {data, size}));
    if (!pairs) {
        fuzz::require(!pairs.error().message.empty(), "a refusal has a reason");
        return 0;
    }
    for (const part::MaterialPair& pair : *pairs) {
        fuzz::require(!part::describeSources(pair).empty(), "a pair has sources");
        if (pair.surface.empty() || !part::findProblems(pair).empty()) continue;
        fuzz::require(part::savePair(own.path(), pair).ok(), "a good pair can be kept");
    }
    static_cast<void>(own.keepOnly("none.txt", {}));
    return 0;
}
