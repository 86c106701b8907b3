#include "core/geometry/triangle_mesh.h"

#include <cmath>

namespace trapwright::geometry {

base::Vec3 triangleNormal(const TriangleMesh& mesh, std::size_t index) {
    const Triangle& t = mesh.triangles[index];
    const base::Vec3& a = mesh.vertices[t[0]];
    const base::Vec3 normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    const double length = normal.norm();
    if (length == 0.0) return base::Vec3::Zero();
    return normal / length;
}

Box calcBoundingBox(const TriangleMesh& mesh) {
    Box box;
    for (const Triangle& triangle : mesh.triangles)
        for (const int vertex : triangle)
            box.include(mesh.vertices[vertex]);
    return box;
}

double calcWindingNumber(const TriangleMesh& mesh, const base::Vec3& point) {
    double halfAngles = 0.0;
    for (const Triangle& triangle : mesh.triangles) {
        const base::Vec3 a = mesh.vertices[triangle[0]] - point;
        const base::Vec3 b = mesh.vertices[triangle[1]] - point;
        const base::Vec3 c = mesh.vertices[triangle[2]] - point;
        const double lengthA = a.norm();
        const double lengthB = b.norm();
        const double lengthC = c.norm();
        const double numerator = a.dot(b.cross(c));
        const double denominator =
            lengthA * lengthB * lengthC + a.dot(b) * lengthC + b.dot(c) * lengthA + c.dot(a) * lengthB;
        halfAngles += std::atan2(numerator, denominator);
    }
    return halfAngles / (2.0 * base::kPi);
}

}  // namespace trapwright::geometry
