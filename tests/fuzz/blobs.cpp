#include <string_view>

#include "core/search/ga/genes.h"
#include "core/store/packing.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// The blobs of a study: what can be unpacked is packed into the same bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view blob(reinterpret_cast<const char*>(data), size);
    // The places after the last bit may hold anything.
    if (const auto bits = search::ga::unpackBits(blob))
        fuzz::require(search::ga::unpackBits(search::ga::packBits(*bits)) == bits, "bits come back");
    if (const auto design = search::unpackDesign(blob)) {
        const std::string packed = search::packDesign(*design);
        const auto back = search::unpackDesign(packed);
        fuzz::require(back && search::packDesign(*back) == packed, "a design comes back");
        fuzz::require(back->size() == design->size(), "with all its numbers");
    }
    if (const auto numbers = store::unpackNumbers(blob))
        fuzz::require(store::packNumbers(*numbers) == blob, "numbers come back");
    if (const auto vertices = store::unpackVertices(blob)) {
        fuzz::require(store::packVertices(*vertices) == blob, "vertices come back");
    }
    constexpr std::size_t kVertices = 1000;
    if (const auto triangles = store::unpackTriangles(blob, kVertices)) {
        fuzz::require(store::packTriangles(*triangles) == blob, "triangles come back");
    }
    return 0;
}
