#include "core/geometry/contact_shape.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/geometry/convex_hull.h"
#include "core/geometry/convex_pieces.h"
#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_check.h"
#include "core/geometry/near_convex_pieces.h"
#include "core/geometry/self_overlap.h"
#include "core/geometry/surface_distance.h"
#include "core/geometry/surface_simplification.h"

namespace trapwright::geometry {

namespace {

constexpr std::size_t kMostCorners = 4000;   // of an exact hull
constexpr std::size_t kMostExact = 20000;    // triangles that are cut apart as they are
constexpr std::size_t kFewTriangles = 3000;  // that need no simplifying
constexpr std::size_t kAimedTriangles = 500;
constexpr std::size_t kMostSimplified = 60000;
constexpr std::size_t kMostPieces = 192;

// Relative to the diagonal of the box around the mesh:
constexpr double kSimplification = 5e-4;  // what is found is up to twice that
constexpr double kNear = 2e-3;
constexpr double kThinning = 5e-4;  // what rolls must not become coarser than simplifying leaves it
constexpr double kFarthest = 1e-2;

// Relative to the volume:
constexpr double kConvexTolerance = 1e-5;
constexpr double kNearVolume = 0.05;

double sumVolumes(const std::vector<ConvexPolytope>& pieces) {
    double sum = 0.0;
    for (const ConvexPolytope& piece : pieces)
        sum += calcMassProperties(toMesh(piece), 1.0).volume;
    return sum;
}

base::Status fillHull(ContactShape& shape, const TriangleMesh& exact, double size) {
    shape.exactCorners = exact.vertices.size();
    const bool isSimple = shape.exactCorners <= kMostCorners;
    auto hull = computeConvexHull(
        isSimple ? exact.vertices
                 : simplifySurface(exact, kAimedTriangles, kSimplification * size).mesh.vertices);
    if (!hull) return hull.error();
    shape.hull = std::move(*hull);
    if (isSimple) {
        shape.exactCorners = shape.hull.vertices.size();
        return base::success();
    }
    const SurfaceDistance surface(toMesh(shape.hull));
    for (const base::Vec3& corner : exact.vertices)
        shape.hullDeviation = std::max(shape.hullDeviation, surface.calcDistance(corner));
    return base::success();
}

/// Why no pieces stand for the solid.
base::Error explain(const TriangleMesh& mesh, double excess) {
    if (const auto place = findOverlap(mesh))
        return {"No convex pieces: the surface crosses or touches itself, at " + formatPlace(*place) +
                ". Repair it in CAD and export it again."};
    return {"No convex pieces: with " + std::to_string(kMostPieces) +
            " of them the shape for contact would be " + std::to_string(excess / base::kMillimetre) +
            " mm off the part. Leave out details that do not touch the track, or use a simpler part."};
}

base::Status fillPieces(ContactShape& shape, const TriangleMesh& mesh, double size) {
    const double volume = calcMassProperties(mesh, 1.0).volume;
    TriangleMesh simplified;
    if (mesh.triangles.size() <= kMostExact) {
        if (auto pieces = computeConvexPieces(mesh)) {
            shape.pieces = std::move(*pieces);
            return base::success();
        }
    }
    if (mesh.triangles.size() > kFewTriangles) {
        SimplifiedSurface surface = simplifySurface(mesh, kAimedTriangles, kSimplification * size);
        simplified = std::move(surface.mesh);
        shape.triangles = simplified.triangles.size();
        shape.deviation = surface.deviation;
        if (shape.triangles > kMostSimplified)
            return base::Error{"No convex pieces: the surface is too involved; simplified to within " +
                               std::to_string(shape.deviation / base::kMillimetre) + " mm it still has " +
                               std::to_string(shape.triangles) + " triangles. Use a simpler part."};
    }
    auto near = computeNearConvexPieces(shape.triangles > 0 ? simplified : mesh, kNear * size,
                                        kThinning * size, kMostPieces);
    if (!near) return near.error();
    if (near->excess > kFarthest * size || std::abs(sumVolumes(near->pieces) - volume) > kNearVolume * volume)
        return explain(mesh, near->excess);
    shape.pieces = std::move(near->pieces);
    shape.deviation += std::max(near->excess, near->shortfall);
    return base::success();
}

}  // namespace

base::Result<ContactShape> computeContactShape(const TriangleMesh& mesh) {
    const auto exact = computeHullMesh(mesh.vertices);
    if (!exact) return exact.error();
    const double volume = calcMassProperties(mesh, 1.0).volume;
    if (!(volume > 0.0))
        return base::Error{
            "No convex pieces: the mesh encloses no volume. Close it and turn its triangles outward."};
    const double size = calcBoundingBox(mesh).size().norm();
    ContactShape shape;
    if (const base::Status status = fillHull(shape, *exact, size); !status) return status.error();
    const double hullVolume = calcMassProperties(*exact, 1.0).volume;
    if (std::abs(hullVolume - volume) <= kConvexTolerance * hullVolume) {
        shape.pieces = {shape.hull};
        shape.deviation = shape.hullDeviation;
        return shape;
    }
    if (const base::Status status = fillPieces(shape, mesh, size); !status) return status.error();
    return shape;
}

}  // namespace trapwright::geometry
