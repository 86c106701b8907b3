#include "core/part/part_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/contact_shape.h"
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

/// Tells of what the part touches with, where that is not just its surface.
void noteShape(const Part& part, const geometry::ContactShape& shape, std::vector<std::string>& notes) {
    if (shape.hull.vertices.size() < shape.exactCorners) {
        notes.push_back(fmt::format(
            "simplified the hull from {} to {} corners: nowhere more than {:.3f} mm inside the surface",
            shape.exactCorners, shape.hull.vertices.size(), shape.hullDeviation / base::kMillimetre));
    }
    if (shape.pieces.size() < 2) return;
    std::string note = fmt::format("not convex: made of {} convex pieces", shape.pieces.size());
    if (shape.triangles > 0) {
        note += fmt::format("; for contact the surface is simplified from {} to {} triangles",
                            part.mesh.triangles.size(), shape.triangles);
    }
    if (shape.deviation > 0.0) {
        note += fmt::format("; they were found nowhere more than {:.3f} mm off the surface",
                            shape.deviation / base::kMillimetre);
    }
    notes.push_back(std::move(note));
}

}  // namespace

base::Result<PreparedPart> buildPart(const geometry::TriangleMesh& mesh, const PartOptions& options,
                                     const BuildProgress& begin) {
    if (const base::Status status = checkOptions(options); !status) return status.error();
    const auto tell = [&](std::string_view stage) {
        if (begin) begin(stage);
    };
    tell("mending the mesh");
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

    tell("convex pieces");
    base::Result<geometry::ContactShape> shape = geometry::computeContactShape(part.mesh);
    if (!shape) return shape.error();
    noteShape(part, *shape, result.notes);
    part.hull = std::move(shape->hull);
    part.pieces = std::move(shape->pieces);

    tell("symmetry");
    if (options.symmetry == SymmetryUse::found) {
        part.symmetry = findSymmetry(part.mesh, part.hull, part.massProperties.inertia,
                                     SymmetryOptions{.tolerance = options.symmetryTolerance});
    }
    tell("stable poses");
    part.stablePoses = computeStablePoses(part.hull, part.symmetry, false);
    return result;
}

}  // namespace trapwright::part
