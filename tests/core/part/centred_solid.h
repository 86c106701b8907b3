#pragma once

#include "core/geometry/convex_hull.h"
#include "core/geometry/mass_properties.h"
#include "core/part/stable_poses.h"
#include "core/part/symmetry.h"

namespace trapwright::part {

/// A closed mesh moved to its centre of mass, with what symmetry and stable poses are found from.
struct CentredSolid {
    geometry::TriangleMesh mesh;
    geometry::ConvexPolytope hull;
    base::Mat3 inertia;

    explicit CentredSolid(geometry::TriangleMesh solid) : mesh(std::move(solid)) {
        const geometry::MassProperties properties = geometry::calcMassProperties(mesh, 1000.0);
        for (base::Vec3& vertex : mesh.vertices)
            vertex -= properties.centre;
        inertia = properties.inertia;
        hull = geometry::computeConvexHull(mesh).value();
    }

    [[nodiscard]] SymmetryGroup symmetry(const SymmetryOptions& options = {}) const {
        return findSymmetry(mesh, hull, inertia, options);
    }
    [[nodiscard]] std::vector<StablePose> poses(bool mergeAlike = false) const {
        return computeStablePoses(hull, symmetry(), mergeAlike);
    }
};

}  // namespace trapwright::part
