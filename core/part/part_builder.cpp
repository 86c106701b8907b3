#include "core/part/part_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/convex_hull.h"
#include "core/geometry/convex_pieces.h"
#include "core/geometry/mesh_repair.h"
#include "core/part/stable_poses.h"

namespace trapwright::part {

namespace {

using base::Error;
using base::Vec3;

// Beyond any solid: osmium has 22590.
constexpr double kLargestDensity = 23000.0;  // [kg/m^3]

base::Status checkOptions(const PartOptions& options) {
    if (!(options.density > 0.0 && options.density <= kLargestDensity)) {
        return Error{fmt::format("the density {} kg/m^3 is out of range. Give one above 0 and up to {}",
                                 options.density, kLargestDensity)};
    }
    if (!(options.symmetryTolerance > 0.0 && options.symmetryTolerance <= 0.1)) {
        return Error{fmt::format(
            "the symmetry tolerance {} is out of range. Give a share of the part's size above 0 and "
            "up to 0.1",
            options.symmetryTolerance)};
    }
    return base::success();
}

}  // namespace

base::Result<PreparedPart> buildPart(const geometry::TriangleMesh& mesh, const PartOptions& options) {
    if (const base::Status status = checkOptions(options); !status) return status.error();
    base::Result<geometry::RepairedMesh> repaired = geometry::repairMesh(mesh);
    if (!repaired) return repaired.error();

    PreparedPart result;
    result.notes = std::move(repaired->notes);
    Part& part = result.part;
    part.name = options.name;
    part.source = options.source;
    part.density = options.density;
    part.mesh = std::move(repaired->mesh);
    part.massProperties = geometry::calcMassProperties(part.mesh, options.density);

    const Vec3 size = geometry::calcBoundingBox(part.mesh).size();
    if (!(part.massProperties.volume > 1e-9 * std::pow(size.maxCoeff(), 3))) {
        return Error{fmt::format(
            "the part has no volume: its box is {:.4g} x {:.4g} x {:.4g} mm. Export it as a solid",
            size.x() * 1e3, size.y() * 1e3, size.z() * 1e3)};
    }
    const Vec3 centre = part.massProperties.centre;
    for (Vec3& vertex : part.mesh.vertices) {
        vertex -= centre;
        part.boundingRadius = std::max(part.boundingRadius, vertex.norm());
    }
    part.massProperties.centre = Vec3::Zero();
    // Less than the rounding of the file's numbers is no move.
    constexpr double kMoveToTell = 1e-6;  // [m]
    if (centre.cwiseAbs().maxCoeff() >= kMoveToTell) {
        // In mm, to a micrometre. Added to zero, it is no "-0".
        const auto told = [](double coordinate) { return std::round(-coordinate * 1e6) / 1e3 + 0.0; };
        result.notes.push_back(fmt::format("moved the origin to the centre of mass, by ({}, {}, {}) mm",
                                           told(centre.x()), told(centre.y()), told(centre.z())));
    }

    base::Result<geometry::ConvexPolytope> hull = geometry::computeConvexHull(part.mesh);
    if (!hull) return hull.error();
    part.hull = std::move(*hull);
    base::Result<std::vector<geometry::ConvexPolytope>> pieces = geometry::computeConvexPieces(part.mesh);
    if (!pieces) return pieces.error();
    part.pieces = std::move(*pieces);
    if (part.pieces.size() > 1) {
        result.notes.push_back(fmt::format("not convex: made of {} convex pieces", part.pieces.size()));
    }

    if (options.symmetry == SymmetryUse::found) {
        part.symmetry = findSymmetry(part.mesh, part.hull, part.massProperties.inertia,
                                     SymmetryOptions{.tolerance = options.symmetryTolerance});
    }
    part.stablePoses = computeStablePoses(part.hull, part.symmetry, false);
    return result;
}

}  // namespace trapwright::part
