#pragma once

#include "core/part/part.h"

namespace trapwright::part {

/// How one part out of production differs from the drawing.
struct Deviation {
    double size = 0.0;  // by which each of its extents is larger, along the file's axes [m]
    base::Vec3 centre = base::Vec3::Zero();  // of mass, off that of the drawing [m]

    [[nodiscard]] bool isNone() const { return size == 0.0 && centre.isZero(0.0); }
};

/// How long, wide and high a part is along the file's axes. [m]
base::Vec3 calcExtents(const Part& part);

/// The part with these deviations: mesh, hull and convex pieces stretched along the file's axes (affine, so
/// that faces stay faces and pieces that touch still do), mass and inertia in closed form, the origin at the
/// centre of mass. Symmetry and stable poses stay those of the drawing: parts are judged by them. Each
/// extent must stay positive.
Part makeSpecimen(const Part& drawing, const Deviation& deviation);

}  // namespace trapwright::part
