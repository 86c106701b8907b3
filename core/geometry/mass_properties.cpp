#include "core/geometry/mass_properties.h"

namespace trapwright::geometry {

MassProperties calcMassProperties(const TriangleMesh& mesh, double density) {
    MassProperties result;
    if (mesh.triangles.empty()) return result;

    // Integrate about the middle of the box: far from the origin the tetrahedra would cancel and lose digits.
    const Box box = calcBoundingBox(mesh);
    const base::Vec3 origin = 0.5 * (box.low + box.high);

    double volume = 0.0;
    base::Vec3 firstMoment = base::Vec3::Zero();
    base::Mat3 secondMoment = base::Mat3::Zero();
    for (const Triangle& triangle : mesh.triangles) {
        const base::Vec3 a = mesh.vertices[triangle[0]] - origin;
        const base::Vec3 b = mesh.vertices[triangle[1]] - origin;
        const base::Vec3 c = mesh.vertices[triangle[2]] - origin;
        result.area += 0.5 * (b - a).cross(c - a).norm();

        // The signed tetrahedron (origin, a, b, c).
        const double sixVolumes = a.dot(b.cross(c));
        const base::Vec3 sum = a + b + c;
        volume += sixVolumes / 6.0;
        firstMoment += sixVolumes / 24.0 * sum;
        secondMoment += sixVolumes / 120.0 *
                        (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
    result.volume = volume;
    result.mass = density * volume;
    result.centre = origin;
    if (volume == 0.0) return result;

    const base::Vec3 centre = firstMoment / volume;
    result.centre += centre;
    const base::Mat3 central = secondMoment - volume * centre * centre.transpose();
    result.inertia = density * (central.trace() * base::Mat3::Identity() - central);
    return result;
}

}  // namespace trapwright::geometry
