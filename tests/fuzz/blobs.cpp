#include <string_view>

#include "core/store/packing.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// The blobs of a study: what can be unpacked is packed into the same bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view blob(reinterpret_cast<const char*>(data), size);
    if (const auto bits = store::unpackBits(blob)) {
        // The places after the last bit may hold anything.
        fuzz::require(store::unpackBits(store::packBits(*bits)) == bits, "bits come back");
    }
    if (const auto vertices = store::unpackVertices(blob)) {
        fuzz::require(store::packVertices(*vertices) == blob, "vertices come back");
    }
    constexpr std::size_t kVertices = 1000;
    if (const auto triangles = store::unpackTriangles(blob, kVertices)) {
        fuzz::require(store::packTriangles(*triangles) == blob, "triangles come back");
    }
    return 0;
}
