#include <fuzzer/FuzzedDataProvider.h>

#include <cmath>

#include "core/part/part_builder.h"
#include "tests/fuzz/scratch_folder.h"

using namespace trapwright;

// A mesh of few triangles between points of a coarse grid, so that they touch, overlap, fold and enclose each
// other: it is refused or gives a part that has a mass and a place to lie on.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr int kGrid = 7;
    constexpr double kSpacing = 3e-3;  // [m]
    constexpr int kMostVertices = 16;
    constexpr int kMostTriangles = 24;
    FuzzedDataProvider input(data, size);
    geometry::TriangleMesh mesh;
    const int vertices = input.ConsumeIntegralInRange<int>(3, kMostVertices);
    const auto coordinate = [&] { return kSpacing * input.ConsumeIntegralInRange<int>(0, kGrid); };
    for (int i = 0; i < vertices; ++i) {
        const double x = coordinate();
        const double y = coordinate();
        mesh.vertices.emplace_back(x, y, coordinate());
    }
    const auto corner = [&] { return input.ConsumeIntegralInRange<int>(0, vertices - 1); };
    while (input.remaining_bytes() >= 3 && mesh.triangles.size() < kMostTriangles) {
        const int a = corner();
        const int b = corner();
        mesh.triangles.push_back({a, b, corner()});
    }

    const auto prepared = part::buildPart(mesh, {.name = "fuzzed"});
    if (!prepared) {
        fuzz::require(!prepared.error().message.empty(), "a refusal has a reason");
        return 0;
    }
    const part::Part& part = prepared->part;
    fuzz::require(std::isfinite(part.massProperties.mass) && part.massProperties.mass > 0.0,
                  "a part has a mass");
    fuzz::require(!part.pieces.empty(), "a part has convex pieces");
    fuzz::require(!part.stablePoses.empty(), "a part has a stable pose");
    return 0;
}
