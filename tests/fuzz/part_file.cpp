#include <cstddef>
#include <cstdint>

#include "core/part/import.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// A part's file of one format, named by TRAPWRIGHT_FUZZ_FORMAT: whatever is in it, it is refused or gives a
// mesh whose triangles have corners that are numbers.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::ScratchFolder folder;
    const auto path = folder.keepOnly("part." TRAPWRIGHT_FUZZ_FORMAT, {data, size});
    const auto imported = part::importMesh(path, "mm");
    if (!imported) {
        fuzz::require(!imported.error().message.empty(), "a refusal has a reason");
        return 0;
    }
    const geometry::TriangleMesh& mesh = imported->mesh;
    fuzz::require(!mesh.triangles.empty(), "an imported part has triangles");
    for (const geometry::Triangle& triangle : mesh.triangles) {
        for (const int corner : triangle) {
            fuzz::require(corner >= 0 && static_cast<std::size_t>(corner) < mesh.vertices.size(),
                          "a triangle's corner is a vertex");
            fuzz::require(mesh.vertices[static_cast<std::size_t>(corner)].allFinite(),
                          "a vertex has coordinates");
        }
    }
    return 0;
}
