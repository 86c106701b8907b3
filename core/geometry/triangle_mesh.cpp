#include "core/geometry/triangle_mesh.h"

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

}  // namespace trapwright::geometry
