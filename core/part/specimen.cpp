#include "core/part/specimen.h"

#include <algorithm>
#include <cassert>

namespace trapwright::part {

namespace {

using base::Mat3;
using base::Vec3;

/// p -> stretch p - shift.
struct Affine {
    Vec3 stretch;
    Vec3 shift;

    [[nodiscard]] Vec3 operator()(const Vec3& p) const { return stretch.cwiseProduct(p) - shift; }
};

void apply(const Affine& map, geometry::ConvexPolytope& polytope) {
    for (geometry::PolytopeFace& face : polytope.faces) {
        // Normals go by the inverse transpose.
        const Vec3 normal = face.normal.cwiseQuotient(map.stretch);
        face.offset = (face.offset - normal.dot(map.shift)) / normal.norm();
        face.normal = normal.normalized();
    }
    for (Vec3& vertex : polytope.vertices)
        vertex = map(vertex);
}

/// Of an affine image about its own centre of mass: moments of second order go as S M S.
Mat3 stretchInertia(const Mat3& inertia, const Vec3& stretch) {
    const Mat3 moments = 0.5 * inertia.trace() * Mat3::Identity() - inertia;
    const Mat3 stretched = stretch.prod() * stretch.asDiagonal() * moments * stretch.asDiagonal();
    return stretched.trace() * Mat3::Identity() - stretched;
}

}  // namespace

base::Vec3 calcExtents(const Part& part) {
    Vec3 low = part.hull.vertices.front();
    Vec3 high = low;
    for (const Vec3& vertex : part.hull.vertices) {
        low = low.cwiseMin(vertex);
        high = high.cwiseMax(vertex);
    }
    return high - low;
}

Part makeSpecimen(const Part& drawing, const Deviation& deviation) {
    Part part = drawing;
    if (deviation.isNone()) return part;
    const Vec3 extents = calcExtents(drawing);
    const Affine map{(extents.array() + deviation.size).matrix().cwiseQuotient(extents), deviation.centre};
    assert((map.stretch.array() > 0.0).all());

    for (Vec3& vertex : part.mesh.vertices)
        vertex = map(vertex);
    apply(map, part.hull);
    for (geometry::ConvexPolytope& piece : part.pieces)
        apply(map, piece);
    geometry::MassProperties& mass = part.massProperties;
    const double volume = map.stretch.prod();
    mass.volume *= volume;
    mass.mass *= volume;
    mass.inertia = stretchInertia(mass.inertia, map.stretch);
    part.boundingRadius = 0.0;
    for (const auto* vertices : {&part.mesh.vertices, &part.hull.vertices})
        for (const Vec3& vertex : *vertices)
            part.boundingRadius = std::max(part.boundingRadius, vertex.norm());
    return part;
}

}  // namespace trapwright::part
